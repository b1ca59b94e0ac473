// SPDX-License-Identifier: MIT
#include "sherd/runtime/bullet/destruction_world.h"

#include <BulletCollision/CollisionDispatch/btCollisionWorld.h>
#include <BulletDynamics/Dynamics/btActionInterface.h>
#include <BulletDynamics/Dynamics/btDynamicsWorld.h>

#include <cmath>
#include <new>

#include "bullet/body_state.h"
#include "bullet/breaker.h"
#include "bullet/bullet_bodies.h"
#include "bullet/convert.h"
#include "sherd/runtime/object_state.h"

namespace sherd {
namespace {

Result<void> checkSpawn(const std::shared_ptr<const Asset>& asset, const RigidPose& pose,
                        const SpawnOptions& options) {
    if (!asset) return fail(ErrorCode::badArgument, "the asset is null; load one first", "asset");
    if (const char* why = whyRefused(pose)) return fail(ErrorCode::badArgument, why, "pose");
    const BodyMotion motion{{}, options.linearVelocity, options.angularVelocity};
    if (const char* why = whyRefused(motion)) return fail(ErrorCode::badArgument, why, "options");
    if (const char* why = whyRefused(options.damage))
        return fail(ErrorCode::badArgument, why, "options.damage");
    return {};
}

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

/// Pushes a body away from a point: N s per m^2 of the circle that its bounding sphere shows it,
/// falling evenly to nothing at `radius`.
void throwFrom(btRigidBody& body, const glm::vec3& point, float radius, float impulsePerArea) {
    if (body.isStaticObject()) return;
    const btVector3 away = body.getCenterOfMassPosition() - toBullet(point);
    const btScalar distance = away.length();
    if (!(distance < radius) || !(distance > 0)) return;
    btVector3 center;
    btScalar size = 0;
    body.getCollisionShape()->getBoundingSphere(center, size);
    const btScalar area = SIMD_PI * size * size;
    body.activate();
    body.applyCentralImpulse(away / distance * impulsePerArea * area * (1 - distance / radius));
}

}  // namespace

class DestructionWorld::Impl final : public btActionInterface {
  public:
    Impl(btDynamicsWorld& bullet, const WorldOptions& options)
        : world(bullet),
          settings(options),
          bodies(bullet, options.overlapTolerance),
          islands(bodies, options.maxPendingEvents),
          breaker(bullet, bodies, islands) {
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
        islands.setTime(islands.time() + double(dt));
        bodies.released().releaseSeparated();
        const bool isTouchable = bodies.readPoses(islands);
        if (!isTouchable || !settings.authority) return;
        bodies.setInStep(inStep);
        breaker.step(dt, inStep);
        islands.workOnStress(toGlm(world.getGravity()), settings.stressIterations);
        bodies.setInStep(false);
        bodies.released().settle();
    }

    /// Leaves whose shape, at its place in the world, is wanted.
    template <class Wanted>
    std::vector<uint32_t> leavesWhere(uint32_t object, const Wanted& wanted) const {
        const IslandWorld::Object& found = islands.object(object);
        const BondGraph& graph = found.asset->graph();
        const FragmentShapes& shapes = bodies.shapesOf(*found.asset);
        std::vector<uint32_t> result;
        for (const uint32_t i : found.islands) {
            const btTransform frame = toBullet(islands.island(i).pose);
            for (const uint32_t fragment : islands.island(i).fragments) {
                const Range leaves = graph.leavesOf(fragment);
                for (uint32_t leaf = leaves.first; leaf < leaves.first + leaves.count; ++leaf) {
                    const uint32_t f = graph.fragmentOfLeaf(leaf);
                    if (wanted(*shapes.shape(f), frame * shapes.bodyFrame(f)))
                        result.push_back(leaf);
                }
            }
        }
        return result;
    }

    /// Island of a standing fragment of a living object; UINT32_MAX when there is none.
    [[nodiscard]] uint32_t find(ObjectId object, uint32_t fragment) const {
        return islands.isAlive(object) ? islands.findIsland(object.index, fragment) : UINT32_MAX;
    }

    btDynamicsWorld& world;
    WorldOptions settings;
    BulletBodies bodies;
    IslandWorld islands;
    Breaker breaker;
};

DestructionWorld::DestructionWorld(btDynamicsWorld& world, const WorldOptions& options)
    : impl_(std::make_unique<Impl>(world, options)) {}

DestructionWorld::~DestructionWorld() = default;

Result<ObjectId> DestructionWorld::spawn(const std::shared_ptr<const Asset>& asset,
                                         const RigidPose& pose, const SpawnOptions& options) {
    if (auto ok = checkSpawn(asset, pose, options); !ok) return tl::unexpected<Error>(ok.error());
    Impl& impl = *impl_;
    if (const char* why = whyRefused(impl.settings.damage))
        return fail(ErrorCode::badArgument, why, "WorldOptions::damage");
    try {
        impl.bodies.prepare(asset);
        // The object's number, and with it its filter, is known only once it is there.
        impl.bodies.setNextFilter(options.collisionGroup, options.collisionMask);
        BodyMotion motion;
        motion.linearVelocity = options.linearVelocity;
        motion.angularVelocity = options.angularVelocity;
        const ObjectId object = impl.islands.spawn(
            asset, pose, combine(impl.settings.damage, options.damage), options.dynamic, motion);
        if (options.anchorToStatic) {
            const auto leaves = impl.leavesWhere(
                object.index, [&](btCollisionShape& shape, const btTransform& place) {
                    return touchesStatic(impl.world, shape, place, kTouch * asset->diagonal());
                });
            impl.islands.pin(object.index, leaves, true);
        }
        return object;
    } catch (const std::bad_alloc&) {
        return fail(ErrorCode::limitExceeded, "not enough memory for the object");
    }
}

bool DestructionWorld::remove(ObjectId object) {
    if (!isAlive(object)) return false;
    impl_->islands.remove(object.index);
    return true;
}

bool DestructionWorld::breakFragment(ObjectId object, uint32_t fragment) {
    if (!isAlive(object) || !impl_->islands.breakFragment(object.index, fragment, false))
        return false;
    impl_->bodies.released().settle();
    return true;
}

bool DestructionWorld::detach(ObjectId object, uint32_t fragment) {
    if (!isAlive(object) || !impl_->islands.breakFragment(object.index, fragment, true))
        return false;
    impl_->bodies.released().settle();
    return true;
}

bool DestructionWorld::breakAll(ObjectId object) {
    if (!isAlive(object)) return false;
    impl_->islands.breakAll(object.index);
    impl_->bodies.released().settle();
    return true;
}

bool DestructionWorld::heal(ObjectId object, float share) {
    if (!isAlive(object)) return false;
    sherd::heal(*impl_->islands.object(object.index).structure, share);
    return true;
}

Result<uint32_t> DestructionWorld::damage(ObjectId object, const AreaDamage& damage) {
    if (const char* why = whyRefused(damage)) return fail(ErrorCode::badArgument, why, "damage");
    if (!isAlive(object)) return fail(ErrorCode::badArgument, "the object is gone", "object");
    const uint32_t broken = impl_->islands.dealArea(object.index, damage);
    impl_->bodies.released().settle();
    return broken;
}

Result<uint32_t> DestructionWorld::damage(const AreaDamage& damage) {
    if (const char* why = whyRefused(damage)) return fail(ErrorCode::badArgument, why, "damage");
    uint32_t broken = 0;
    for (uint32_t object = 0; object < impl_->islands.objectCount(); ++object)
        if (isAlive(impl_->islands.idOf(object))) broken += impl_->islands.dealArea(object, damage);
    impl_->bodies.released().settle();
    return broken;
}

Result<uint32_t> DestructionWorld::explode(const AreaDamage& damage, float impulsePerArea) {
    if (damage.shape != AreaDamage::Shape::sphere)
        return fail(ErrorCode::badArgument, "an explosion is a sphere", "damage.shape");
    if (!std::isfinite(impulsePerArea))
        return fail(ErrorCode::badArgument, "the impulse must be finite", "impulsePerArea");
    Result<uint32_t> broken = this->damage(damage);
    if (!broken) return broken;
    for (uint32_t i = 0; i < impl_->islands.islands().size(); ++i)
        if (impl_->islands.island(i).isAlive)
            throwFrom(impl_->bodies.body(i), damage.a, damage.radius, impulsePerArea);
    return broken;
}

Result<float> DestructionWorld::reportHit(const btCollisionObject& body, const ReportedHit& hit,
                                          int child) {
    const uint32_t island = impl_->bodies.islandOf(body);
    if (island == UINT32_MAX)
        return fail(ErrorCode::badArgument, "the body is none of Sherd's", "body");
    if (const char* why = whyRefused(hit)) return fail(ErrorCode::badArgument, why, "hit");
    const float consumed =
        impl_->islands.takeHit(island, impl_->bodies.fragmentOf(island, child), hit);
    impl_->bodies.released().settle();
    return consumed;
}

bool DestructionWorld::anchor(ObjectId object, uint32_t fragment, bool anchored) {
    if (!isAlive(object) || !impl_->islands.pinFragment(object.index, fragment, anchored))
        return false;
    impl_->bodies.released().settle();
    return true;
}

uint32_t DestructionWorld::anchorInBox(ObjectId object, const glm::vec3& low,
                                       const glm::vec3& high) {
    if (!isAlive(object)) return 0;
    return impl_->islands.pinInBox(object.index, low, high);
}

std::vector<uint8_t> DestructionWorld::save(ObjectId object) const {
    if (!isAlive(object)) return {};
    std::vector<uint8_t> bodies;
    ByteWriter to(bodies);
    for (const uint32_t i : impl_->islands.object(object.index).islands)
        writeBodyState(impl_->bodies.body(i), to);
    return saveObject(impl_->islands, object.index, kBulletState, bodies);
}

Result<void> DestructionWorld::restore(ObjectId object, std::span<const uint8_t> bytes) {
    if (!isAlive(object)) return fail(ErrorCode::badArgument, "the object is gone", "object");
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
    restoreObject(impl_->islands, object.index, std::move(*saved));
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

void DestructionWorld::afterStep(float dt) {
    if (impl_->settings.drive == Drive::manual && dt > 0) impl_->step(dt, false);
}

std::span<const FragmentPose> DestructionWorld::poses() const {
    return impl_->islands.poses();
}

std::span<const BreakEvent> DestructionWorld::events() {
    return impl_->islands.takeEvents();
}

bool DestructionWorld::isAlive(ObjectId object) const {
    return impl_->islands.isAlive(object);
}

btRigidBody* DestructionWorld::body(ObjectId object, uint32_t fragment) const {
    const uint32_t island = impl_->find(object, fragment);
    return island == UINT32_MAX ? nullptr : &impl_->bodies.body(island);
}

std::optional<BodyInfo> DestructionWorld::find(const btCollisionObject& body, int child) const {
    const uint32_t island = impl_->bodies.islandOf(body);
    if (island == UINT32_MAX) return std::nullopt;
    return BodyInfo{impl_->islands.idOf(impl_->islands.island(island).object),
                    impl_->bodies.fragmentOf(island, child)};
}

const Structure* DestructionWorld::structure(ObjectId object) const {
    return isAlive(object) ? impl_->islands.object(object.index).structure.get() : nullptr;
}

float DestructionWorld::overload(ObjectId object, uint32_t bond) const {
    return isAlive(object) ? impl_->islands.overload(object.index, bond) : 0;
}

uint32_t DestructionWorld::bodyCount() const {
    return impl_->islands.islandCount();
}

uint32_t DestructionWorld::ignoredPairCount() const {
    return uint32_t(impl_->bodies.released().ignoredCount());
}

double DestructionWorld::time() const {
    return impl_->islands.time();
}

}  // namespace sherd
