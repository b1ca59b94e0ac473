// SPDX-License-Identifier: MIT
#include "sherd/runtime/bullet/destruction_world.h"

#include <BulletCollision/CollisionDispatch/btCollisionWorld.h>
#include <BulletDynamics/Dynamics/btActionInterface.h>
#include <BulletDynamics/Dynamics/btDynamicsWorld.h>
#include <LinearMath/btAabbUtil2.h>

#include <algorithm>
#include <cmath>
#include <new>

#include "bullet/breaker.h"
#include "bullet/bullet_bodies.h"
#include "bullet/convert.h"
#include "bullet/object_snapshot.h"
#include "bullet/resting_pieces.h"
#include "core/debris.h"
#include "core/finite.h"
#include "core/structure_bytes.h"

namespace sherd {
namespace {

Result<void> checkSpawn(const std::shared_ptr<const Asset>& asset, const RigidPose& pose,
                        const SpawnOptions& options) {
    if (!asset) return fail(ErrorCode::badArgument, "the asset is null; load one first", "asset");
    if (!isSound(pose)) {
        return fail(ErrorCode::badArgument,
                    "the pose must have a finite place and a unit quaternion", "pose");
    }
    if (!isFinite(options.linearVelocity) || !isFinite(options.angularVelocity)) {
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

constexpr uint32_t kSavedObject = 0x32484453;  // "SDH2": what it is, and its version

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

class DestructionWorld::Impl final : public btActionInterface {
  public:
    Impl(btDynamicsWorld& bullet, const WorldOptions& options)
        : world(bullet),
          settings(options),
          bodies(bullet, options.overlapTolerance, options.freezeAfter),
          islands(bodies, options.maxPendingEvents),
          breaker(bullet, bodies, islands),
          debris(options.debris) {
        islands.setFade(settings.debris.fade);
        islands.allowBodies(settings.maxNewBodiesPerStep);
        islands.allowAwake(settings.maxAwakeBodies);
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
        const uint32_t awake = bodies.awakeDebris();
        islands.allowAwake(settings.maxAwakeBodies - std::min(settings.maxAwakeBodies, awake));
        if (isTouchable && settings.authority) {
            bodies.setInStep(inStep);
            breaker.step(dt, inStep);
            islands.workOnStress(toGlm(world.getGravity()), settings.stressIterations);
            bodies.setInStep(false);
            bodies.released().settle();
        }
        bodies.setInStep(inStep);
        debris.step(islands);
        bodies.quiet().step(islands.time());
        bodies.setInStep(false);
        islands.allowBodies(settings.maxNewBodiesPerStep);
    }

    /// Breaks something of an object by `breakIt`. What was at rest may rest on.
    template <class Break>
    auto release(uint32_t object, const Break& breakIt) {
        const bool rests = releasesAsleep.size() > object && releasesAsleep[object] != 0 &&
                           isAtRest(islands, bodies, object);
        const auto result = breakIt();
        if (rests) restWhatIsBorne(world, islands, bodies, object);
        return result;
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
    Debris debris;
    std::vector<uint8_t> releasesAsleep;  ///< per object
};

DestructionWorld::DestructionWorld(btDynamicsWorld& world, const WorldOptions& options)
    : impl_(std::make_unique<Impl>(world, options)) {}

DestructionWorld::~DestructionWorld() = default;

Result<ObjectId> DestructionWorld::spawn(const std::shared_ptr<const Asset>& asset,
                                         const RigidPose& pose, const SpawnOptions& options) {
    if (auto ok = checkSpawn(asset, pose, options); !ok) return tl::unexpected<Error>(ok.error());
    Impl& impl = *impl_;
    try {
        impl.bodies.prepare(asset);
        // The object's number, and with it its filter, is known only once it is there.
        impl.bodies.setNextFilter(options.collisionGroup, options.collisionMask);
        BodyMotion motion;
        motion.linearVelocity = options.linearVelocity;
        motion.angularVelocity = options.angularVelocity;
        const ObjectId object = impl.islands.spawn(
            asset, pose, combine(impl.settings.damage, options.damage), options.dynamic, motion);
        impl.releasesAsleep.resize(std::max<size_t>(impl.releasesAsleep.size(), object.index + 1));
        impl.releasesAsleep[object.index] = options.releaseAsleep ? 1 : 0;
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
    if (!isAlive(object)) return false;
    const bool broken = impl_->release(
        object.index, [&] { return impl_->islands.breakFragment(object.index, fragment, false); });
    if (!broken) return false;
    impl_->bodies.released().settle();
    return true;
}

bool DestructionWorld::detach(ObjectId object, uint32_t fragment) {
    if (!isAlive(object)) return false;
    const bool broken = impl_->release(
        object.index, [&] { return impl_->islands.breakFragment(object.index, fragment, true); });
    if (!broken) return false;
    impl_->bodies.released().settle();
    return true;
}

bool DestructionWorld::breakAll(ObjectId object) {
    if (!isAlive(object)) return false;
    (void)impl_->release(object.index, [&] {
        impl_->islands.breakAll(object.index);
        return true;
    });
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
    const uint32_t broken =
        impl_->release(object.index, [&] { return impl_->islands.dealArea(object.index, damage); });
    impl_->bodies.released().settle();
    return broken;
}

Result<uint32_t> DestructionWorld::damage(const AreaDamage& damage) {
    if (const char* why = whyRefused(damage)) return fail(ErrorCode::badArgument, why, "damage");
    uint32_t broken = 0;
    for (uint32_t object = 0; object < impl_->islands.objectCount(); ++object)
        if (isAlive(impl_->islands.idOf(object)))
            broken +=
                impl_->release(object, [&] { return impl_->islands.dealArea(object, damage); });
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
            throwFrom(impl_->bodies.body(i), impl_->bodies.quiet(), i, damage.a, damage.radius,
                      impulsePerArea);
    return broken;
}

Result<float> DestructionWorld::reportHit(const btCollisionObject& body, const ReportedHit& hit,
                                          int child) {
    const uint32_t island = impl_->bodies.islandOf(body);
    if (island == UINT32_MAX)
        return fail(ErrorCode::badArgument, "the body is none of Sherd's", "body");
    if (!isFinite(hit.point) || !isFinite(hit.normal) || !(hit.energy >= 0) || !(hit.speed >= 0) ||
        !(hit.impulse >= 0))
        return fail(ErrorCode::badArgument,
                    "place and direction must be finite, energy, speed and impulse not negative",
                    "hit");
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
    const btVector3 lowCorner = toBullet(low), highCorner = toBullet(high);
    const auto leaves = impl_->leavesWhere(
        object.index, [&](const btCollisionShape& shape, const btTransform& place) {
            btVector3 shapeLow, shapeHigh;
            shape.getAabb(place, shapeLow, shapeHigh);
            return TestAabbAgainstAabb2(shapeLow, shapeHigh, lowCorner, highCorner);
        });
    impl_->islands.pin(object.index, leaves, true);
    return uint32_t(leaves.size());
}

std::vector<uint8_t> DestructionWorld::save(ObjectId object) const {
    std::vector<uint8_t> bytes;
    if (!isAlive(object)) return bytes;
    ByteWriter to(bytes);
    const IslandWorld::Object& saved = impl_->islands.object(object.index);
    to.u32(kSavedObject);
    to.f64(time());
    writeStructure(*saved.structure, to);
    to.u32(uint32_t(saved.islands.size()));
    for (const uint32_t i : saved.islands)
        writeIsland(impl_->islands.island(i), impl_->bodies.body(i), to);
    return bytes;
}

Result<void> DestructionWorld::restore(ObjectId object, std::span<const uint8_t> bytes) {
    if (!isAlive(object)) return fail(ErrorCode::badArgument, "the object is gone", "object");
    ByteReader from(bytes);
    if (from.u32() != kSavedObject)
        return fail(ErrorCode::invalidData, "these are not the bytes of a saved object", "bytes");
    const double savedAt = from.f64();
    IslandWorld::Object& restored = impl_->islands.object(object.index);
    auto snapshot = readSnapshot(restored.asset, from);
    if (!snapshot) return tl::unexpected<Error>(snapshot.error());
    if (!from.isAtEnd() || !std::isfinite(savedAt))
        return fail(ErrorCode::invalidData, "the saved object does not end where it should",
                    "bytes");
    for (auto& island : snapshot->islands) {
        island.bornAt += time() - savedAt;
        island.fadingSince += time() - savedAt;
    }
    impl_->islands.replace(object.index, std::move(*snapshot->structure),
                           std::move(snapshot->islands));
    for (size_t i = 0; i < restored.islands.size(); ++i) {
        btRigidBody& body = impl_->bodies.body(restored.islands[i]);
        restoreBody(snapshot->bodies[i], body);
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

std::span<const RemovalEvent> DestructionWorld::removals() {
    return impl_->islands.takeRemovals();
}

bool DestructionWorld::removePiece(ObjectId object, uint32_t fragment) {
    const uint32_t island = impl_->find(object, fragment);
    if (island == UINT32_MAX) return false;
    impl_->islands.removeIsland(island, RemovalReason::game);
    return true;
}

void DestructionWorld::setViewer(const glm::vec3& position) {
    if (isFinite(position)) impl_->debris.setViewer(position);
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

uint32_t DestructionWorld::frozenCount() const {
    return impl_->bodies.quiet().frozenCount();
}

bool DestructionWorld::isFrozen(ObjectId object, uint32_t fragment) const {
    const uint32_t island = impl_->find(object, fragment);
    return island != UINT32_MAX && impl_->bodies.quiet().isFrozen(island);
}

bool DestructionWorld::wake(ObjectId object, uint32_t fragment) {
    const uint32_t island = impl_->find(object, fragment);
    if (island == UINT32_MAX) return false;
    impl_->bodies.quiet().wake(island);
    impl_->bodies.body(island).activate();
    return true;
}

uint32_t DestructionWorld::ignoredPairCount() const {
    return uint32_t(impl_->bodies.released().ignoredCount());
}

double DestructionWorld::time() const {
    return impl_->islands.time();
}

}  // namespace sherd
