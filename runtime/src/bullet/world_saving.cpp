// SPDX-License-Identifier: MIT
// Objects of a DestructionWorld as bytes.
#include <optional>
#include <utility>

#include "bullet/body_state.h"
#include "bullet/convert.h"
#include "bullet/destruction_world_impl.h"
#include "sherd/runtime/object_state.h"

namespace sherd {
namespace {

/// A body of Sherd's that stands where an adopted one does.
btRigidBody standIn(const btRigidBody& body, const BodyMotion& motion) {
    btRigidBody result(1, nullptr, nullptr);
    result.setWorldTransform(toBullet(motion.pose));
    result.setLinearVelocity(toBullet(motion.linearVelocity));
    result.setAngularVelocity(toBullet(motion.angularVelocity));
    result.forceActivationState(body.getActivationState());
    result.setDeactivationTime(body.getDeactivationTime());
    return result;
}

}  // namespace

std::vector<uint8_t> DestructionWorld::save(ObjectId object) const {
    if (!impl_->isThere(object)) return {};
    std::vector<uint8_t> bodies;
    ByteWriter to(bodies);
    for (const uint32_t i : impl_->islands.object(object.index).islands) {
        const btRigidBody& body = impl_->bodies.body(i);
        if (impl_->bodies.isAdopted(i))
            writeBodyState(standIn(body, impl_->bodies.motion(i)), to);
        else
            writeBodyState(body, to);
    }
    return saveObject(impl_->islands, object.index, kBulletState, bodies);
}

Result<void> DestructionWorld::restore(ObjectId object, std::span<const uint8_t> bytes) {
    const MemoryScope scope(impl_->memory);
    if (!impl_->isThere(object))
        return fail(ErrorCode::badArgument, "the object is gone", "object");
    const IslandWorld::Object& restored = impl_->islands.object(object.index);
    auto saved = readSavedObject(restored.asset, bytes);
    if (!saved) return tl::unexpected<Error>(saved.error());
    std::optional<std::vector<BodyState>> states;
    if (saved->engine == kBulletState) {
        states = readBodyStates(saved->engineBytes, saved->islands.size());
        if (!states)
            return fail(ErrorCode::invalidData,
                        "the saved object is unusable: its bodies' states are none", "bytes");
    }
    if (!restored.islands.empty() && impl_->bodies.isAdopted(restored.islands.front()))
        impl_->bodies.giveBack(restored.islands.front());
    restoreObject(impl_->islands, object.index, std::move(*saved));
    impl_->bodies.announce(restored.islands);
    for (size_t i = 0; i < restored.islands.size(); ++i) {
        btRigidBody& body = impl_->bodies.body(restored.islands[i]);
        if (states) restoreBodyState((*states)[i], body);
        impl_->bodies.noteTransform(restored.islands[i]);
        if (body.isInWorld()) impl_->world.updateSingleAabb(&body);
    }
    impl_->bodies.released().addGroup(restored.islands);
    impl_->bodies.released().settle();
    return {};
}

}  // namespace sherd
