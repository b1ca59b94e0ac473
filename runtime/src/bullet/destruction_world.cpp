// SPDX-License-Identifier: MIT
#include "sherd/runtime/bullet/destruction_world.h"

#include <BulletCollision/CollisionDispatch/btCollisionWorld.h>
#include <BulletDynamics/Dynamics/btActionInterface.h>
#include <BulletDynamics/Dynamics/btDynamicsWorld.h>
#include <LinearMath/btAabbUtil2.h>

#include <cmath>
#include <new>

#include "bullet/body_store.h"
#include "bullet/breaker.h"
#include "bullet/convert.h"
#include "core/structure_bytes.h"

namespace sherd {
namespace {

bool finite(const glm::vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

Result<void> checkSpawn(const std::shared_ptr<const Asset>& asset, const RigidPose& pose,
                        const SpawnOptions& options) {
    if (!asset) return fail(ErrorCode::badArgument, "the asset is null; load one first", "asset");
    const float norm = glm::dot(pose.rotation, pose.rotation);
    if (!finite(pose.translation) || !std::isfinite(norm) || std::abs(norm - 1) > 1e-3F) {
        return fail(ErrorCode::badArgument,
                    "the pose must have a finite place and a unit quaternion", "pose");
    }
    if (!finite(options.linearVelocity) || !finite(options.angularVelocity)) {
        return fail(ErrorCode::badArgument, "the velocities must be finite", "options");
    }
    const DamageOptions& damage = options.damage;
    const bool damageOk = damage.toughnessScale > 0 && damage.strengthScale > 0 &&
                          damage.levelScale > 0 && damage.immunity >= 0 &&
                          damage.minimumImpulse >= 0 && damage.minimumEnergy >= 0;
    if (!damageOk) {
        return fail(ErrorCode::badArgument,
                    "the scales must be positive, the minimum values and times not negative",
                    "options.damage");
    }
    return {};
}

constexpr uint32_t kSavedObject = 0x31484453;  // "SDH1": what it is, and its version

constexpr float kTouch = 1e-3F;  // of the object's diagonal: how near is touching

/// Whether a shape at a place comes as near as `tolerance`, metres, to something static.
bool touchesStatic(btCollisionWorld& world, btCollisionShape& shape, const btTransform& place,
                   float tolerance) {
    struct Touch : btCollisionWorld::ContactResultCallback {
        bool found = false;
        bool needsCollision(btBroadphaseProxy* proxy) const override {
            const auto* other = static_cast<const btCollisionObject*>(proxy->m_clientObject);
            return other->isStaticObject() && other->hasContactResponse();
        }
        btScalar addSingleResult(btManifoldPoint& point, const btCollisionObjectWrapper*, int, int,
                                 const btCollisionObjectWrapper*, int, int) override {
            found = found || point.getDistance() <= m_closestDistanceThreshold;
            return 0;
        }
    };
    btCollisionObject probe;
    probe.setCollisionShape(&shape);
    probe.setWorldTransform(place);
    Touch touch;
    touch.m_closestDistanceThreshold = tolerance;
    world.contactTest(&probe, touch);
    return touch.found;
}

}  // namespace

class DestructionWorld::Impl final : public btActionInterface {
  public:
    Impl(btDynamicsWorld& bullet, const WorldOptions& options)
        : world(bullet), settings(options), store(bullet), breaker(bullet, store, options) {
        if (settings.drive == Drive::action) world.addAction(this);
    }
    ~Impl() override {
        if (settings.drive == Drive::action) world.removeAction(this);
    }
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;

    // Bullet runs actions at the end of every substep, when the contact points hold its impulses.
    void updateAction(btCollisionWorld* /*world*/, btScalar dt) override { step(dt, true); }
    void debugDraw(btIDebugDraw* /*drawer*/) override {}

    // Out of memory within a step ends the program rather than leave half a swap behind.
    void step(float dt, bool inStep) noexcept {
        time += dt;
        breaker.step(time, dt, inStep);
    }

    btDynamicsWorld& world;
    WorldOptions settings;
    BodyStore store;
    Breaker breaker;
    double time = 0;
};

DestructionWorld::DestructionWorld(btDynamicsWorld& world, const WorldOptions& options)
    : impl_(std::make_unique<Impl>(world, options)) {}

DestructionWorld::~DestructionWorld() = default;

Result<ObjectId> DestructionWorld::spawn(const std::shared_ptr<const Asset>& asset,
                                         const RigidPose& pose, const SpawnOptions& options) {
    if (auto ok = checkSpawn(asset, pose, options); !ok) return tl::unexpected<Error>(ok.error());
    SpawnOptions combined = options;
    combined.damage = combine(impl_->settings.damage, options.damage);
    try {
        const ObjectId object = impl_->store.spawn(asset, pose, combined);
        if (options.anchorToStatic) {
            impl_->store.pinLeaves(
                object.index, [&](btCollisionShape& shape, const btTransform& at) {
                    return touchesStatic(impl_->world, shape, at, kTouch * asset->diagonal());
                });
            impl_->breaker.followPins(object.index, impl_->time);
        }
        return object;
    } catch (const std::bad_alloc&) {
        return fail(ErrorCode::limitExceeded, "not enough memory for the object");
    }
}

bool DestructionWorld::remove(ObjectId object) {
    if (!impl_->store.isAlive(object)) return false;
    impl_->breaker.removeObject(object.index);
    return true;
}

bool DestructionWorld::breakFragment(ObjectId object, uint32_t fragment) {
    if (!impl_->store.isAlive(object)) return false;
    const uint32_t island = impl_->store.findIsland(object.index, fragment);
    if (island == UINT32_MAX) return false;
    const Asset& asset = impl_->store.object(object.index).asset();
    if (asset.fragment(fragment).children.count == 0) return false;
    impl_->breaker.breakFragment(island, fragment, false, impl_->time);
    return true;
}

bool DestructionWorld::detach(ObjectId object, uint32_t fragment) {
    if (!impl_->store.isAlive(object)) return false;
    const uint32_t island = impl_->store.findIsland(object.index, fragment);
    if (island == UINT32_MAX) return false;
    impl_->breaker.breakFragment(island, fragment, true, impl_->time);
    return true;
}

bool DestructionWorld::breakAll(ObjectId object) {
    if (!impl_->store.isAlive(object)) return false;
    impl_->breaker.breakAll(object.index, impl_->time);
    return true;
}

bool DestructionWorld::heal(ObjectId object, float share) {
    if (!impl_->store.isAlive(object)) return false;
    sherd::heal(*impl_->store.object(object.index).structure, share);
    return true;
}

Result<uint32_t> DestructionWorld::damage(ObjectId object, const AreaDamage& damage) {
    if (const char* why = whyRefused(damage)) return fail(ErrorCode::badArgument, why, "damage");
    if (!impl_->store.isAlive(object))
        return fail(ErrorCode::badArgument, "the object is gone", "object");
    return impl_->breaker.dealArea(object.index, damage, impl_->time);
}

Result<uint32_t> DestructionWorld::damage(const AreaDamage& damage) {
    if (const char* why = whyRefused(damage)) return fail(ErrorCode::badArgument, why, "damage");
    uint32_t broken = 0;
    for (uint32_t object = 0; object < impl_->store.objectCount(); ++object)
        if (impl_->store.isAlive(impl_->store.idOf(object)))
            broken += impl_->breaker.dealArea(object, damage, impl_->time);
    return broken;
}

Result<uint32_t> DestructionWorld::explode(const AreaDamage& damage, float impulsePerArea) {
    if (damage.shape != AreaDamage::Shape::sphere)
        return fail(ErrorCode::badArgument, "an explosion is a sphere", "damage.shape");
    if (!std::isfinite(impulsePerArea))
        return fail(ErrorCode::badArgument, "the impulse must be finite", "impulsePerArea");
    Result<uint32_t> broken = this->damage(damage);
    if (broken) impl_->store.throwFrom(damage.a, damage.radius, impulsePerArea);
    return broken;
}

Result<float> DestructionWorld::reportHit(const btCollisionObject& body, const ReportedHit& hit,
                                          int child) {
    const uint32_t island = impl_->store.islandOf(body);
    if (island == UINT32_MAX)
        return fail(ErrorCode::badArgument, "the body is none of Sherd's", "body");
    if (!finite(hit.point) || !finite(hit.normal) || !(hit.energy >= 0) || !(hit.speed >= 0) ||
        !(hit.impulse >= 0))
        return fail(ErrorCode::badArgument,
                    "place and direction must be finite, energy, speed and impulse not negative",
                    "hit");
    return impl_->breaker.reportHit(island, hit, child, impl_->time);
}

bool DestructionWorld::anchor(ObjectId object, uint32_t fragment, bool anchored) {
    if (!impl_->store.isAlive(object)) return false;
    if (!impl_->store.pin(object.index, fragment, anchored)) return false;
    impl_->breaker.followPins(object.index, impl_->time);
    return true;
}

uint32_t DestructionWorld::anchorInBox(ObjectId object, const glm::vec3& low,
                                       const glm::vec3& high) {
    if (!impl_->store.isAlive(object)) return 0;
    const btVector3 lowCorner = toBullet(low), highCorner = toBullet(high);
    const uint32_t count = impl_->store.pinLeaves(
        object.index, [&](btCollisionShape& shape, const btTransform& place) {
            btVector3 shapeLow, shapeHigh;
            shape.getAabb(place, shapeLow, shapeHigh);
            return TestAabbAgainstAabb2(shapeLow, shapeHigh, lowCorner, highCorner);
        });
    impl_->breaker.followPins(object.index, impl_->time);
    return count;
}

std::vector<uint8_t> DestructionWorld::save(ObjectId object) const {
    std::vector<uint8_t> bytes;
    if (!impl_->store.isAlive(object)) return bytes;
    ByteWriter to(bytes);
    const Object& saved = impl_->store.object(object.index);
    to.u32(kSavedObject);
    to.f64(impl_->time);
    writeStructure(*saved.structure, to);
    to.u32(uint32_t(saved.bodies.size()));
    for (const uint32_t island : saved.bodies) writeBody(impl_->store.island(island), to);
    return bytes;
}

Result<void> DestructionWorld::restore(ObjectId object, std::span<const uint8_t> bytes) {
    if (!impl_->store.isAlive(object))
        return fail(ErrorCode::badArgument, "the object is gone", "object");
    ByteReader from(bytes);
    if (from.u32() != kSavedObject)
        return fail(ErrorCode::invalidData, "these are not the bytes of a saved object", "bytes");
    const double time = from.f64();
    auto snapshot = readSnapshot(impl_->store.object(object.index).shapes->asset(), from);
    if (!snapshot) return tl::unexpected<Error>(snapshot.error());
    if (!from.isAtEnd() || !std::isfinite(time))
        return fail(ErrorCode::invalidData, "the saved object does not end where it should",
                    "bytes");
    for (BodySnapshot& body : snapshot->bodies) body.bornAt += impl_->time - time;
    impl_->breaker.replaceObject(object.index, std::move(*snapshot));
    return {};
}

void DestructionWorld::afterStep(float dt) {
    if (impl_->settings.drive == Drive::manual && dt > 0) impl_->step(dt, false);
}

std::span<const FragmentPose> DestructionWorld::poses() const {
    return impl_->store.poses();
}

std::span<const BreakEvent> DestructionWorld::events() {
    return impl_->breaker.takeEvents();
}

bool DestructionWorld::isAlive(ObjectId object) const {
    return impl_->store.isAlive(object);
}

btRigidBody* DestructionWorld::body(ObjectId object, uint32_t fragment) const {
    if (!impl_->store.isAlive(object)) return nullptr;
    const uint32_t island = impl_->store.findIsland(object.index, fragment);
    return island == UINT32_MAX ? nullptr : impl_->store.island(island).body.get();
}

std::optional<BodyInfo> DestructionWorld::find(const btCollisionObject& body, int child) const {
    const uint32_t index = impl_->store.islandOf(body);
    if (index == UINT32_MAX) return std::nullopt;
    return BodyInfo{impl_->store.idOf(impl_->store.island(index).object),
                    impl_->store.fragmentOf(index, child)};
}

const Structure* DestructionWorld::structure(ObjectId object) const {
    if (!impl_->store.isAlive(object)) return nullptr;
    return impl_->store.object(object.index).structure.get();
}

uint32_t DestructionWorld::bodyCount() const {
    return impl_->store.bodyCount();
}

uint32_t DestructionWorld::ignoredPairCount() const {
    return uint32_t(impl_->breaker.ignoredPairCount());
}

double DestructionWorld::time() const {
    return impl_->time;
}

}  // namespace sherd
