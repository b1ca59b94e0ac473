// SPDX-License-Identifier: MIT
#include "sherd/runtime/bullet/destruction_world.h"

#include <BulletCollision/CollisionDispatch/btCollisionWorld.h>
#include <BulletDynamics/Dynamics/btActionInterface.h>
#include <BulletDynamics/Dynamics/btDynamicsWorld.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <optional>

#include "bullet/adviser.h"
#include "bullet/body_state.h"
#include "bullet/breaker.h"
#include "bullet/bullet_bodies.h"
#include "bullet/convert.h"
#include "bullet/resting_pieces.h"
#include "core/debris.h"
#include "core/finite.h"
#include "core/report.h"
#include "sherd/runtime/bullet/game_listener.h"
#include "sherd/runtime/bullet/prepared_asset.h"
#include "sherd/runtime/object_state.h"

namespace sherd {
namespace {

/// Of what stands for the asset.
Result<void> checkInstance(const std::shared_ptr<const Asset>& asset, const RigidPose& pose,
                           float scale, const DamageOptions& damage) {
    if (!asset) return fail(ErrorCode::badArgument, "the asset is null; load one first", "asset");
    if (const char* why = whyRefused(pose)) return fail(ErrorCode::badArgument, why, "pose");
    if (!(scale > 0) || !std::isfinite(scale))
        return fail(ErrorCode::badArgument, "the scale must be positive and finite",
                    "options.scale");
    if (const char* why = whyRefused(damage))
        return fail(ErrorCode::badArgument, why, "options.damage");
    return {};
}

/// Large lists are kept, too.
constexpr std::pmr::pool_options kPools{0, size_t{1} << 22};

constexpr const char* kTelling = "a GameListener must not change the world that calls it";

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

/// What comes off collides as the body did: as what Bullet makes of it where the game left that to
/// Bullet.
BodyFilter filterOf(const btRigidBody& body, const AdoptOptions& options) {
    if (options.collisionGroup != 0 || options.collisionMask != 0)
        return {options.collisionGroup, options.collisionMask};
    const btBroadphaseProxy& proxy = *body.getBroadphaseProxy();
    const bool isFixed = body.isStaticOrKinematicObject();
    const int group = isFixed ? btBroadphaseProxy::StaticFilter : btBroadphaseProxy::DefaultFilter;
    const int mask = isFixed ? btBroadphaseProxy::AllFilter ^ btBroadphaseProxy::StaticFilter
                             : btBroadphaseProxy::AllFilter;
    if (proxy.m_collisionFilterGroup == group && proxy.m_collisionFilterMask == mask) return {};
    return {proxy.m_collisionFilterGroup, proxy.m_collisionFilterMask};
}

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

/// Who has pinned an object.
enum class Hold : uint8_t { none, toStatic, byGame };

}  // namespace

class DestructionWorld::Impl final : public btActionInterface {
  public:
    Impl(btDynamicsWorld& bullet, const WorldOptions& options)
        : memory(kPools, options.allocator ? options.allocator : std::pmr::new_delete_resource()),
          making(std::in_place, memory),
          world(bullet),
          settings(options),
          bodies(bullet, options.overlapTolerance, options.freezeAfter),
          islands(bodies, options.maxPendingEvents),
          breaker(bullet, bodies, islands, options.leastImpact),
          debris(options.debris) {
        bodies.attach(islands, settings.rules, settings.listener, settings.leastImpact);
        islands.setFade(settings.debris.fade);
        islands.allowBodies(settings.maxNewBodiesPerStep);
        islands.allowAwake(settings.maxAwakeBodies);
        making.reset();
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
        const MemoryScope scope(memory);
        islands.setTime(islands.time() + double(dt));
        lastStep = dt;
        bodies.noticeGone();
        bodies.released().releaseSeparated();
        const bool isTouchable = bodies.readPoses(islands);
        const uint32_t awake = bodies.awakeDebris();
        islands.allowAwake(settings.maxAwakeBodies - std::min(settings.maxAwakeBodies, awake));
        if (isTouchable) breaker.measure(dt, inStep);
        if (isTouchable && settings.authority) {
            bodies.setInStep(inStep);
            breaker.breakWhatIsHit();
            islands.workOnStress(toGlm(world.getGravity()), settings.stressIterations);
            bodies.setInStep(false);
            bodies.released().settle();
        }
        bodies.setInStep(inStep);
        debris.step(islands);
        bodies.quiet().step(islands.time());
        bodies.setInStep(false);
        bodies.approaches().clear();
        islands.allowBodies(settings.maxNewBodiesPerStep);
    }

    /// Breaks something of an object by `breakIt`. What was at rest may rest on.
    template <class Break>
    void release(uint32_t object, const Break& breakIt) {
        const bool rests = releasesAsleep.size() > object && releasesAsleep[object] != 0 &&
                           isAtRest(islands, bodies, object);
        breakIt();
        if (rests) restWhatIsBorne(world, islands, bodies, object);
        bodies.released().settle();
    }

    bool breakOut(ObjectId object, uint32_t fragment, bool whole) {
        const MemoryScope scope(memory);
        if (!isThere(object)) return false;
        bool isBroken = false;
        release(object.index,
                [&] { isBroken = islands.breakFragment(object.index, fragment, whole); });
        return isBroken;
    }

    uint32_t dealArea(uint32_t object, const AreaDamage& damage) {
        uint32_t broken = 0;
        release(object, [&] { broken = islands.dealArea(object, damage); });
        return broken;
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

    void anchorToStatic(uint32_t object) {
        const float tolerance = kTouch * islands.object(object).asset->diagonal();
        const auto leaves =
            leavesWhere(object, [&](btCollisionShape& shape, const btTransform& place) {
                return touchesStatic(world, shape, place, tolerance);
            });
        islands.pin(object, leaves, true);
    }

    Hold& holds(uint32_t object) {
        if (holds_.size() <= object) holds_.resize(object + 1, Hold::none);
        return holds_[object];
    }

    /// Whether it is alive, and the game has not just taken it away. Before something changes.
    bool isThere(ObjectId object) {
        if (!SHERD_ASSERT(!bodies.isTelling())) return false;
        bodies.noticeGone();
        return islands.isAlive(object);
    }

    /// Island of a standing fragment of a living object; UINT32_MAX when there is none.
    [[nodiscard]] uint32_t find(ObjectId object, uint32_t fragment) {
        bodies.noticeGone();
        return islands.isAlive(object) ? islands.findIsland(object.index, fragment) : UINT32_MAX;
    }

    std::pmr::unsynchronized_pool_resource memory;
    std::optional<MemoryScope> making;  ///< what follows

    btDynamicsWorld& world;
    WorldOptions settings;
    BulletBodies bodies;
    IslandWorld islands;
    Breaker breaker;
    Debris debris;
    std::vector<uint8_t> releasesAsleep;  ///< per object
    float lastStep = 0;                   ///< s; 0: none yet

  private:
    std::vector<Hold> holds_;  ///< per object
};

DestructionWorld::DestructionWorld(btDynamicsWorld& world, const WorldOptions& options)
    : impl_(std::make_unique<Impl>(world, options)) {}

DestructionWorld::~DestructionWorld() = default;

Result<ObjectId> DestructionWorld::spawn(const std::shared_ptr<const Asset>& asset,
                                         const RigidPose& pose, const SpawnOptions& options) {
    const MemoryScope scope(impl_->memory);
    if (auto ok = checkInstance(asset, pose, options.scale, options.damage); !ok)
        return tl::unexpected<Error>(ok.error());
    if (!isFinite(options.linearVelocity) || !isFinite(options.angularVelocity))
        return fail(ErrorCode::badArgument, "the velocities must be finite", "options");
    Impl& impl = *impl_;
    if (!SHERD_ASSERT(!impl.bodies.isTelling())) return fail(ErrorCode::badArgument, kTelling);
    if (const char* why = whyRefused(impl.settings.damage))
        return fail(ErrorCode::badArgument, why, "WorldOptions::damage");
    try {
        auto sized = impl.bodies.assets().take(asset, options.scale);
        if (!sized) return tl::unexpected<Error>(sized.error());
        // The object's number, and with it its filter, is known only once it is there.
        impl.bodies.setNextFilter(options.collisionGroup, options.collisionMask);
        BodyMotion motion;
        motion.linearVelocity = options.linearVelocity;
        motion.angularVelocity = options.angularVelocity;
        const ObjectId object = impl.islands.spawn(
            *sized, pose, combine(impl.settings.damage, options.damage), options.dynamic, motion);
        impl.releasesAsleep.resize(std::max<size_t>(impl.releasesAsleep.size(), object.index + 1));
        impl.releasesAsleep[object.index] = options.releaseAsleep ? 1 : 0;
        impl.holds(object.index) = options.anchorToStatic ? Hold::toStatic : Hold::none;
        if (options.anchorToStatic) impl.anchorToStatic(object.index);
        return object;
    } catch (const std::bad_alloc&) {
        return fail(ErrorCode::limitExceeded, "not enough memory for the object");
    }
}

Result<ObjectId> DestructionWorld::adopt(btRigidBody& body,
                                         const std::shared_ptr<const Asset>& asset,
                                         const AdoptOptions& options) {
    const MemoryScope scope(impl_->memory);
    if (auto ok = checkInstance(asset, options.objectToBody, options.scale, options.damage); !ok)
        return tl::unexpected<Error>(ok.error());
    Impl& impl = *impl_;
    if (!SHERD_ASSERT(!impl.bodies.isTelling())) return fail(ErrorCode::badArgument, kTelling);
    impl.bodies.noticeGone();
    if (!body.isInWorld() || impl.world.getCollisionObjectArray().findLinearSearch(&body) ==
                                 impl.world.getNumCollisionObjects())
        return fail(ErrorCode::badArgument, "the body must be in the Bullet world", "body");
    if (impl.bodies.islandOf(body) != UINT32_MAX)
        return fail(ErrorCode::badArgument, "the body is Sherd's, or adopted already", "body");
    try {
        auto sized = impl.bodies.assets().take(asset, options.scale);
        if (!sized) return tl::unexpected<Error>(sized.error());
        // As heavy as the game has it, or what comes off would carry another momentum.
        constexpr float kSameMass = 1e-5F;
        const float mass = (*sized)->fragment(0).mass;
        if (!body.isStaticOrKinematicObject() &&
            std::abs(body.getMass() - mass) > kSameMass * mass) {
            sized = impl.bodies.assets().take(*sized, 1, body.getMass() / mass);
            if (!sized) return tl::unexpected<Error>(sized.error());
        }
        const BodyFilter filter = filterOf(body, options);
        impl.bodies.setNextFilter(filter.group, filter.mask);
        impl.bodies.setNextAdopted(body, options.objectToBody);
        const RigidPose pose = toPose(body.getWorldTransform() * toBullet(options.objectToBody));
        const ObjectId object =
            impl.islands.spawn(*sized, pose, combine(impl.settings.damage, options.damage),
                               !body.isStaticOrKinematicObject(), {});
        impl.holds(object.index) = Hold::none;
        return object;
    } catch (const std::bad_alloc&) {
        return fail(ErrorCode::limitExceeded, "not enough memory for the object");
    }
}

Result<void> DestructionWorld::use(const PreparedAsset& prepared) {
    if (!prepared.asset || !prepared.shapes)
        return fail(ErrorCode::badArgument, "nothing is prepared", "prepared");
    impl_->bodies.assets().add(prepared);
    return {};
}

void DestructionWorld::trim() {
    impl_->bodies.assets().trim();
}

Result<Reload> DestructionWorld::reload(const std::shared_ptr<const Asset>& old,
                                        const std::shared_ptr<const Asset>& fresh) {
    const MemoryScope scope(impl_->memory);
    if (!old || !fresh)
        return fail(ErrorCode::badArgument, "the asset is null; load one first",
                    old ? "fresh" : "old");
    Impl& impl = *impl_;
    impl.bodies.noticeGone();
    Reload result;
    for (uint32_t o = 0; o < impl.islands.objectCount(); ++o) {
        const IslandWorld::Object& object = impl.islands.object(o);
        if (!object.asset || &object.asset->original() != &old->original()) continue;
        auto sized = impl.bodies.assets().take(fresh, object.asset->scale() / fresh->scale(),
                                               object.asset->density() / fresh->density());
        if (!sized) return tl::unexpected<Error>(sized.error());
        const ObjectId id = impl.islands.idOf(o);
        const bool isWhole = !object.structure->isDamaged() && object.islands.size() == 1 &&
                             !impl.bodies.isAdopted(object.islands.front());
        const bool isHeld = isWhole && impl.holds(o) == Hold::toStatic;
        if (isHeld) impl.islands.pinFragment(o, 0, false);
        if (!isWhole || !impl.islands.exchange(o, *sized)) {
            result.kept.push_back(id);
            continue;
        }
        if (isHeld) impl.anchorToStatic(o);
        ++result.exchanged;
    }
    impl.bodies.released().settle();
    trim();
    return result;
}

std::vector<Advice> DestructionWorld::advice() const {
    impl_->bodies.noticeGone();
    return adviseOn(impl_->world, impl_->bodies.assets(), impl_->bodies, impl_->settings,
                    impl_->lastStep);
}

bool DestructionWorld::remove(ObjectId object) {
    if (!impl_->isThere(object)) return false;
    impl_->islands.remove(object.index);
    return true;
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

bool DestructionWorld::freeze(ObjectId object, uint32_t fragment) {
    const uint32_t island = impl_->find(object, fragment);
    if (island == UINT32_MAX) return false;
    btRigidBody& body = impl_->bodies.body(island);
    if (!body.isStaticOrKinematicObject()) putToSleep(body);
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
    impl_->holds(object.index) = Hold::byGame;
    impl_->bodies.released().settle();
    return true;
}

uint32_t DestructionWorld::anchorInBox(ObjectId object, const glm::vec3& low,
                                       const glm::vec3& high) {
    const MemoryScope scope(impl_->memory);
    if (!impl_->isThere(object)) return 0;
    const uint32_t count = impl_->islands.pinInBox(object.index, low, high);
    if (count > 0) impl_->holds(object.index) = Hold::byGame;
    return count;
}

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

void DestructionWorld::afterStep(float dt) {
    if (!SHERD_ASSERT(impl_->settings.drive == Drive::manual) || !SHERD_ASSERT(dt > 0)) return;
    impl_->step(dt, false);
}

std::span<const FragmentPose> DestructionWorld::poses() const {
    return impl_->islands.poses();
}

std::span<const Range> DestructionWorld::changedPoses() {
    return impl_->islands.changedPoses();
}

std::span<const ImpactEvent> DestructionWorld::impacts() {
    return impl_->islands.takeImpacts();
}

std::span<const IslandEvent> DestructionWorld::islandEvents() {
    return impl_->islands.takeIslandEvents();
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

bool DestructionWorld::setLoad(ObjectId object, uint32_t fragment, const glm::vec3& force) {
    return impl_->isThere(object) && impl_->islands.setLoad(object.index, {fragment, force});
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
