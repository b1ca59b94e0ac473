// SPDX-License-Identifier: MIT
#include "sherd/runtime/object_state.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "core/byte_stream.h"
#include "core/structure_bytes.h"

namespace sherd {
namespace {

constexpr uint32_t kSavedObject = 0x484453;  // "SDH", and a byte for the version
constexpr uint32_t kVersion = '3';
constexpr size_t kLeastIslandBytes = 133;

void write(const glm::vec3& v, ByteWriter& to) {
    for (int i = 0; i < 3; ++i) to.f32(v[i]);
}
void write(const RigidPose& pose, ByteWriter& to) {
    write(pose.translation, to);
    for (int i = 0; i < 4; ++i) to.f32(pose.rotation[i]);
}

glm::vec3 readVector(ByteReader& from) {
    const float x = from.f32(), y = from.f32(), z = from.f32();
    return {x, y, z};
}
RigidPose readPose(ByteReader& from) {
    RigidPose pose;
    pose.translation = readVector(from);
    for (int i = 0; i < 4; ++i) pose.rotation[i] = from.f32();
    return pose;
}

void writeIsland(const IslandWorld& world, uint32_t index, ByteWriter& to) {
    const IslandWorld::Island& island = world.island(index);
    const IslandWorld::Places& places = world.placesOf(index);
    const BodyMotion motion = world.motionOf(index);
    to.u32(uint32_t(island.fragments.size()));
    for (const uint32_t fragment : island.fragments) to.u32(fragment);
    to.u8(uint8_t((island.isFixed ? 1 : 0) | (island.isAnchored ? 2 : 0)));
    to.f64(island.bornAt);
    to.f64(island.fadingSince);
    write(places.now, to);
    write(places.before, to);
    write(motion.pose, to);
    write(motion.linearVelocity, to);
    write(motion.angularVelocity, to);
}

IslandWorld::SavedIsland readIsland(ByteReader& from) {
    IslandWorld::SavedIsland island;
    const uint32_t count = from.count(4);
    island.fragments.reserve(count);
    for (uint32_t n = count; n > 0; --n) island.fragments.push_back(from.u32());
    const uint8_t flags = from.u8();
    island.isFixed = (flags & 1) != 0;
    island.isAnchored = (flags & 2) != 0;
    island.bornAt = from.f64();
    island.fadingSince = from.f64();
    island.places.now = readPose(from);
    island.places.before = readPose(from);
    island.motion.pose = readPose(from);
    island.motion.linearVelocity = readVector(from);
    island.motion.angularVelocity = readVector(from);
    return island;
}

bool isSound(const IslandWorld::SavedIsland& island) {
    return !whyRefused(island.places.now) && !whyRefused(island.places.before) &&
           !whyRefused(island.motion) && !std::isnan(island.bornAt) &&
           !std::isnan(island.fadingSince) && island.fadingSince > -HUGE_VAL;
}

/// Every fragment that stands is part of one island, and each island is one piece; the others were
/// removed.
const char* whyRefused(const SavedObject& saved) {
    const Asset& asset = saved.structure.asset();
    uint32_t leaves = 0;
    for (uint32_t leaf = 0; leaf < asset.graph().leafCount(); ++leaf)
        leaves += saved.structure.isGone(leaf) ? 1 : 0;
    IslandFinder groups;
    std::vector<uint8_t> seen(asset.fragmentCount(), 0);
    for (const IslandWorld::SavedIsland& island : saved.islands) {
        const Vector<uint32_t>& fragments = island.fragments;
        if (!isSound(island)) return "the numbers of an island or its body are none";
        if (fragments.empty() || !std::is_sorted(fragments.begin(), fragments.end()))
            return "an island's fragments are not in order";
        for (const uint32_t f : fragments) {
            if (f >= asset.fragmentCount() || seen[f] != 0 || !saved.structure.stands(f))
                return "an island holds a fragment that does not stand, or is in two";
            seen[f] = 1;
            leaves += asset.graph().leavesOf(f).count;
        }
        groups.find(saved.structure, fragments);
        if (groups.islands().size() != 1) return "an island does not hang together";
        if (groups.islands()[0].anchored != island.isAnchored)
            return "an island is not anchored as its fragments are";
    }
    return leaves == asset.graph().leafCount() ? nullptr : "a part of the object is missing";
}

tl::unexpected<Error> refuse(const char* why) {
    return fail(ErrorCode::invalidData, std::string("the saved object is unusable: ") + why,
                "bytes");
}

}  // namespace

std::vector<uint8_t> saveObject(const IslandWorld& world, uint32_t object, uint32_t engine,
                                std::span<const uint8_t> engineBytes) {
    std::vector<uint8_t> bytes;
    ByteWriter to(bytes);
    const IslandWorld::Object& saved = world.object(object);
    to.u32(kSavedObject | kVersion << 24);
    to.f64(world.time());
    writeStructure(*saved.structure, to);
    to.u32(uint32_t(saved.islands.size()));
    for (const uint32_t i : saved.islands) writeIsland(world, i, to);
    to.u32(engine);
    to.u32(uint32_t(engineBytes.size()));
    bytes.insert(bytes.end(), engineBytes.begin(), engineBytes.end());
    return bytes;
}

Result<SavedObject> readSavedObject(const std::shared_ptr<const Asset>& asset,
                                    std::span<const uint8_t> bytes) {
    ByteReader from(bytes);
    const uint32_t mark = from.u32();
    if ((mark & 0xFFFFFF) != kSavedObject || from.isShort())
        return fail(ErrorCode::invalidData, "these are not the bytes of a saved object", "bytes");
    if (mark >> 24 != kVersion)
        return refuse("another version of Sherd wrote it, and this one cannot read it");
    const double savedAt = from.f64();
    std::optional<Structure> structure;
    if (const char* why = readStructure(asset, from, structure)) return refuse(why);
    SavedObject saved{savedAt, std::move(*structure), {}, 0, {}};
    const uint32_t count = from.count(kLeastIslandBytes);
    saved.islands.reserve(count);
    for (uint32_t n = count; n > 0; --n) saved.islands.push_back(readIsland(from));
    saved.engine = from.u32();
    saved.engineBytes = from.bytes(from.count(1));
    if (from.isShort()) return refuse("it ends too early");
    if (!from.isAtEnd() || !std::isfinite(savedAt))
        return refuse("it does not end where it should");
    if (const char* why = whyRefused(saved)) return refuse(why);
    return saved;
}

void restoreObject(IslandWorld& world, uint32_t object, SavedObject&& saved) {
    for (auto& island : saved.islands) {
        island.bornAt += world.time() - saved.savedAt;
        island.fadingSince += world.time() - saved.savedAt;
    }
    world.replace(object, std::move(saved.structure), std::move(saved.islands));
}

}  // namespace sherd
