// SPDX-License-Identifier: MIT
#include "bullet/object_snapshot.h"

#include <algorithm>
#include <cmath>

#include "bullet/convert.h"
#include "core/finite.h"
#include "core/structure_bytes.h"

namespace sherd {
namespace {

void write(const btVector3& v, ByteWriter& to) {
    for (int i = 0; i < 3; ++i) to.f32(v[i]);
}
void write(const RigidPose& pose, ByteWriter& to) {
    for (int i = 0; i < 3; ++i) to.f32(pose.translation[i]);
    for (int i = 0; i < 4; ++i) to.f32(pose.rotation[i]);
}

btVector3 readVector(ByteReader& from) {
    const float x = from.f32(), y = from.f32(), z = from.f32();
    return {x, y, z};
}
RigidPose readPose(ByteReader& from) {
    RigidPose pose;
    for (int i = 0; i < 3; ++i) pose.translation[i] = from.f32();
    for (int i = 0; i < 4; ++i) pose.rotation[i] = from.f32();
    return pose;
}

bool isFinite(const btVector3& v) {
    return sherd::isFinite(toGlm(v));
}
bool isSound(const BodySnapshot& body) {
    const btMatrix3x3 turn = body.transform.getBasis() * body.transform.getBasis().transpose();
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            if (!(std::abs(turn[i][j] - (i == j ? 1 : 0)) < 1e-3F)) return false;
    return isFinite(body.transform.getOrigin()) && isFinite(body.linear) &&
           isFinite(body.angular) && body.activation >= ACTIVE_TAG &&
           body.activation <= DISABLE_SIMULATION && body.quietFor >= 0;
}
bool isSound(const IslandWorld::SavedIsland& island) {
    return sherd::isSound(island.pose) && sherd::isSound(island.previous) &&
           !std::isnan(island.bornAt) && !std::isnan(island.fadingSince) &&
           island.fadingSince > -HUGE_VAL;
}

IslandWorld::SavedIsland readIsland(ByteReader& from) {
    IslandWorld::SavedIsland island;
    for (uint32_t n = from.count(4); n > 0; --n) island.fragments.push_back(from.u32());
    const uint8_t flags = from.u8();
    island.isFixed = (flags & 1) != 0;
    island.isAnchored = (flags & 2) != 0;
    island.bornAt = from.f64();
    island.fadingSince = from.f64();
    island.pose = readPose(from);
    island.previous = readPose(from);
    return island;
}

BodySnapshot readBody(ByteReader& from) {
    BodySnapshot body;
    for (int row = 0; row < 3; ++row) body.transform.getBasis()[row] = readVector(from);
    body.transform.setOrigin(readVector(from));
    body.linear = readVector(from);
    body.angular = readVector(from);
    body.activation = from.u8();
    body.quietFor = from.f32();
    return body;
}

}  // namespace

void writeIsland(const IslandWorld::Island& island, const btRigidBody& body, ByteWriter& to) {
    to.u32(uint32_t(island.fragments.size()));
    for (const uint32_t fragment : island.fragments) to.u32(fragment);
    to.u8(uint8_t((island.isFixed ? 1 : 0) | (island.isAnchored ? 2 : 0)));
    to.f64(island.bornAt);
    to.f64(island.fadingSince);
    write(island.pose, to);
    write(island.previous, to);
    for (int row = 0; row < 3; ++row) write(body.getWorldTransform().getBasis()[row], to);
    write(body.getWorldTransform().getOrigin(), to);
    write(body.getLinearVelocity(), to);
    write(body.getAngularVelocity(), to);
    to.u8(uint8_t(body.getActivationState()));
    to.f32(body.getDeactivationTime());
}

void restoreBody(const BodySnapshot& snapshot, btRigidBody& body) {
    body.setWorldTransform(snapshot.transform);
    body.setInterpolationWorldTransform(snapshot.transform);
    body.setLinearVelocity(snapshot.linear);
    body.setAngularVelocity(snapshot.angular);
    body.setInterpolationLinearVelocity(snapshot.linear);
    body.setInterpolationAngularVelocity(snapshot.angular);
    body.updateInertiaTensor();
    body.forceActivationState(snapshot.activation);
    body.setDeactivationTime(snapshot.quietFor);
}

Result<ObjectSnapshot> readSnapshot(const std::shared_ptr<const Asset>& asset, ByteReader& from) {
    const auto refuse = [](const char* why) {
        return fail(ErrorCode::invalidData, std::string("the saved object is unusable: ") + why,
                    "bytes");
    };
    ObjectSnapshot snapshot;
    if (const char* why = readStructure(asset, from, snapshot.structure)) return refuse(why);
    constexpr size_t kLeastBytes = 148;  // of a body
    for (uint32_t n = from.count(kLeastBytes); n > 0; --n) {
        snapshot.islands.push_back(readIsland(from));
        snapshot.bodies.push_back(readBody(from));
    }
    if (from.isShort()) return refuse("it ends too early");
    // Every fragment that stands is part of one body; the others were removed.
    uint32_t leaves = 0;
    for (uint32_t leaf = 0; leaf < asset->graph().leafCount(); ++leaf)
        leaves += snapshot.structure->isGone(leaf) ? 1 : 0;
    std::vector<uint8_t> seen(asset->fragmentCount(), 0);
    for (const BodySnapshot& body : snapshot.bodies)
        if (!isSound(body)) return refuse("a body's numbers are none");
    for (const IslandWorld::SavedIsland& island : snapshot.islands) {
        const std::vector<uint32_t>& fragments = island.fragments;
        if (!isSound(island)) return refuse("an island's numbers are none");
        if (fragments.empty() || !std::is_sorted(fragments.begin(), fragments.end()))
            return refuse("an island's fragments are not in order");
        for (const uint32_t f : fragments) {
            if (f >= asset->fragmentCount() || seen[f] != 0 || !snapshot.structure->stands(f))
                return refuse("an island holds a fragment that does not stand, or is in two");
            seen[f] = 1;
            leaves += asset->graph().leavesOf(f).count;
        }
    }
    if (leaves != asset->graph().leafCount()) return refuse("a part of the object is missing");
    return snapshot;
}

}  // namespace sherd
