// SPDX-License-Identifier: MIT
#include "bullet/object_snapshot.h"

#include <algorithm>
#include <cmath>

#include "bullet/body_store.h"
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
    return std::isfinite(v.x()) && std::isfinite(v.y()) && std::isfinite(v.z());
}
bool isSound(const RigidPose& pose) {
    const glm::vec3& t = pose.translation;
    return std::isfinite(t.x) && std::isfinite(t.y) && std::isfinite(t.z) &&
           std::abs(glm::dot(pose.rotation, pose.rotation) - 1) < 1e-3F;
}
bool isSound(const BodySnapshot& body) {
    const btMatrix3x3 turn = body.transform.getBasis() * body.transform.getBasis().transpose();
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            if (!(std::abs(turn[i][j] - (i == j ? 1 : 0)) < 1e-3F)) return false;
    return isFinite(body.transform.getOrigin()) && isFinite(body.linear) &&
           isFinite(body.angular) && isSound(body.pose) && isSound(body.previous) &&
           !std::isnan(body.bornAt) && body.activation >= ACTIVE_TAG &&
           body.activation <= DISABLE_SIMULATION && body.quietFor >= 0;
}

BodySnapshot readBody(ByteReader& from) {
    BodySnapshot body;
    for (uint32_t n = from.count(4); n > 0; --n) body.fragments.push_back(from.u32());
    const uint8_t flags = from.u8();
    body.isFixed = (flags & 1) != 0;
    body.isAnchored = (flags & 2) != 0;
    body.bornAt = from.f64();
    body.pose = readPose(from);
    body.previous = readPose(from);
    for (int row = 0; row < 3; ++row) body.transform.getBasis()[row] = readVector(from);
    body.transform.setOrigin(readVector(from));
    body.linear = readVector(from);
    body.angular = readVector(from);
    body.activation = from.u8();
    body.quietFor = from.f32();
    return body;
}

}  // namespace

void writeBody(const IslandBody& island, ByteWriter& to) {
    const btRigidBody& body = *island.body;
    to.u32(uint32_t(island.fragments.size()));
    for (const uint32_t fragment : island.fragments) to.u32(fragment);
    to.u8(uint8_t((body.isStaticObject() ? 1 : 0) | (island.isAnchored ? 2 : 0)));
    to.f64(island.bornAt);
    write(island.pose, to);
    write(island.previous, to);
    for (int row = 0; row < 3; ++row) write(body.getWorldTransform().getBasis()[row], to);
    write(body.getWorldTransform().getOrigin(), to);
    write(body.getLinearVelocity(), to);
    write(body.getAngularVelocity(), to);
    to.u8(uint8_t(body.getActivationState()));
    to.f32(body.getDeactivationTime());
}

Result<ObjectSnapshot> readSnapshot(const std::shared_ptr<const Asset>& asset, ByteReader& from) {
    const auto refuse = [](const char* why) {
        return fail(ErrorCode::invalidData, std::string("the saved object is unusable: ") + why,
                    "bytes");
    };
    ObjectSnapshot snapshot;
    if (const char* why = readStructure(asset, from, snapshot.structure)) return refuse(why);
    constexpr size_t kLeastBytes = 140;  // of a body
    for (uint32_t n = from.count(kLeastBytes); n > 0; --n)
        snapshot.bodies.push_back(readBody(from));
    if (from.isShort()) return refuse("it ends too early");
    // Every fragment that stands is part of one body.
    uint32_t leaves = 0;
    std::vector<uint8_t> seen(asset->fragmentCount(), 0);
    for (const BodySnapshot& body : snapshot.bodies) {
        if (!isSound(body)) return refuse("a body's numbers are none");
        if (body.fragments.empty() || !std::is_sorted(body.fragments.begin(), body.fragments.end()))
            return refuse("a body's fragments are not in order");
        for (const uint32_t f : body.fragments) {
            if (f >= asset->fragmentCount() || seen[f] != 0 || !snapshot.structure->stands(f))
                return refuse("a body holds a fragment that does not stand, or is in two");
            seen[f] = 1;
            leaves += asset->graph().leavesOf(f).count;
        }
    }
    if (leaves != asset->graph().leafCount()) return refuse("a part of the object is missing");
    return snapshot;
}

}  // namespace sherd
