// SPDX-License-Identifier: MIT
// What a game does to objects of a DestructionWorld, and what it holds them by.
#include <algorithm>
#include <cmath>

#include "bullet/convert.h"
#include "bullet/destruction_world_impl.h"
#include "core/finite.h"

namespace sherd {
namespace {

/// Whether the box around a body reaches into a sphere.
bool reaches(const AreaDamage& sphere, const btRigidBody& body) {
    btVector3 low, high;
    body.getAabb(low, high);
    btVector3 nearest = toBullet(sphere.a);
    nearest.setMax(low);
    nearest.setMin(high);
    return nearest.distance(toBullet(sphere.a)) <= sphere.radius;
}

/// Pushes a body away from a point: N s per m^2 of the circle that its bounding sphere shows it,
/// falling evenly to nothing at `radius`.
void throwFrom(btRigidBody& body, QuietDebris& quiet, uint32_t island, const glm::vec3& point,
               float radius, float impulsePerArea) {
    if (body.getInvMass() == 0) return;
    const btVector3 away = body.getCenterOfMassPosition() - toBullet(point);
    const btScalar distance = away.length();
    if (!(distance < radius) || !(distance > 0)) return;
    btVector3 center;
    btScalar size = 0;
    body.getCollisionShape()->getBoundingSphere(center, size);
    const btScalar area = SIMD_PI * size * size;
    quiet.wake(island);
    body.activate();
    body.applyCentralImpulse(away / distance * impulsePerArea * area * (1 - distance / radius));
}

}  // namespace

bool DestructionWorld::Impl::breakOut(ObjectId object, uint32_t fragment, bool whole) {
    const MemoryScope scope(memory);
    if (!isThere(object)) return false;
    bool isBroken = false;
    release(object.index, [&] { isBroken = islands.breakFragment(object.index, fragment, whole); });
    return isBroken;
}

uint32_t DestructionWorld::Impl::dealArea(uint32_t object, const AreaDamage& damage) {
    uint32_t broken = 0;
    release(object, [&] { broken = islands.dealArea(object, damage); });
    return broken;
}

bool DestructionWorld::breakFragment(ObjectId object, uint32_t fragment) {
    return impl_->breakOut(object, fragment, false);
}

bool DestructionWorld::detach(ObjectId object, uint32_t fragment) {
    return impl_->breakOut(object, fragment, true);
}

bool DestructionWorld::breakAll(ObjectId object) {
    const MemoryScope scope(impl_->memory);
    if (!impl_->isThere(object)) return false;
    impl_->release(object.index, [&] { impl_->islands.breakAll(object.index); });
    return true;
}

bool DestructionWorld::heal(ObjectId object, float share) {
    if (!impl_->isThere(object)) return false;
    sherd::heal(*impl_->islands.object(object.index).structure, share);
    return true;
}

Result<uint32_t> DestructionWorld::damage(ObjectId object, const AreaDamage& damage) {
    const MemoryScope scope(impl_->memory);
    if (const char* why = whyRefused(damage)) return fail(ErrorCode::badArgument, why, "damage");
    if (!impl_->isThere(object))
        return fail(ErrorCode::badArgument, "the object is gone", "object");
    return impl_->dealArea(object.index, damage);
}

Result<uint32_t> DestructionWorld::damage(const AreaDamage& damage) {
    const MemoryScope scope(impl_->memory);
    if (const char* why = whyRefused(damage)) return fail(ErrorCode::badArgument, why, "damage");
    uint32_t broken = 0;
    for (uint32_t object = 0; object < impl_->islands.objectCount(); ++object)
        if (impl_->isThere(impl_->islands.idOf(object))) broken += impl_->dealArea(object, damage);
    return broken;
}

Result<uint32_t> DestructionWorld::explode(const AreaDamage& damage, float impulsePerArea) {
    if (damage.shape != AreaDamage::Shape::sphere)
        return fail(ErrorCode::badArgument, "an explosion is a sphere", "damage.shape");
    if (!std::isfinite(impulsePerArea))
        return fail(ErrorCode::badArgument, "the impulse must be finite", "impulsePerArea");
    if (const char* why = whyRefused(damage)) return fail(ErrorCode::badArgument, why, "damage");
    impl_->bodies.noticeGone();
    for (uint32_t i = 0; i < impl_->islands.islands().size(); ++i)
        if (impl_->islands.island(i).isAlive && reaches(damage, impl_->bodies.body(i)))
            impl_->bodies.body(i).activate();
    Result<uint32_t> broken = this->damage(damage);
    if (!broken) return broken;
    for (uint32_t i = 0; i < impl_->islands.islands().size(); ++i)
        if (impl_->islands.island(i).isAlive)
            throwFrom(impl_->bodies.body(i), impl_->bodies.quiet(), i, damage.a, damage.radius,
                      impulsePerArea);
    return broken;
}

Result<float> DestructionWorld::reportHit(const btCollisionObject& body, const ReportedHit& hit,
                                          int child) {
    const MemoryScope scope(impl_->memory);
    impl_->bodies.noticeGone();
    const uint32_t island = impl_->bodies.islandOf(body);
    if (island == UINT32_MAX)
        return fail(ErrorCode::badArgument, "the body is none of Sherd's", "body");
    if (const char* why = whyRefused(hit)) return fail(ErrorCode::badArgument, why, "hit");
    impl_->bodies.body(island).activate();
    const uint32_t fragment = impl_->bodies.fragmentAt(island, child, toBullet(hit.point));
    if (hit.energy >= impl_->settings.leastImpact) impl_->islands.addImpact(island, fragment, hit);
    const float consumed = impl_->islands.takeHit(island, fragment, hit);
    impl_->bodies.released().settle();
    return consumed;
}

bool DestructionWorld::anchor(ObjectId object, uint32_t fragment, bool anchored) {
    const MemoryScope scope(impl_->memory);
    if (!impl_->isThere(object) || !impl_->islands.pinFragment(object.index, fragment, anchored))
        return false;
    impl_->holds(object.index) = Impl::Hold::byGame;
    impl_->bodies.released().settle();
    return true;
}

uint32_t DestructionWorld::anchorInBox(ObjectId object, const glm::vec3& low,
                                       const glm::vec3& high) {
    const MemoryScope scope(impl_->memory);
    if (!impl_->isThere(object)) return 0;
    const uint32_t count = impl_->islands.pinInBox(object.index, low, high);
    if (count > 0) impl_->holds(object.index) = Impl::Hold::byGame;
    return count;
}

bool DestructionWorld::setLoad(ObjectId object, uint32_t fragment, const glm::vec3& force) {
    return impl_->isThere(object) && impl_->islands.setLoad(object.index, {fragment, force});
}

}  // namespace sherd
