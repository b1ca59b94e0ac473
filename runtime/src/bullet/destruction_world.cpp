// SPDX-License-Identifier: MIT
#include "sherd/runtime/bullet/destruction_world.h"

#include <algorithm>
#include <memory_resource>
#include <optional>

#include "bullet/adviser.h"
#include "bullet/convert.h"
#include "bullet/destruction_world_impl.h"
#include "bullet/resting_pieces.h"
#include "core/finite.h"

namespace sherd {

DestructionWorld::Impl::Impl(btDynamicsWorld& bullet, const WorldOptions& options)
    : memory(options.allocator ? options.allocator : std::pmr::new_delete_resource()),
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

DestructionWorld::Impl::~Impl() {
    if (settings.drive == Drive::action) world.removeAction(this);
}

void DestructionWorld::Impl::step(float dt, bool inStep) noexcept {
    const MemoryScope scope(memory);
    islands.setTime(islands.time() + double(dt));
    lastStep = dt;
    bodies.noticeGone();
    bodies.released().releaseSeparated();
    const bool isTouchable = bodies.readPlaces();
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

bool DestructionWorld::Impl::restsWhenReleased(uint32_t object) {
    return releasesAsleep.size() > object && releasesAsleep[object] != 0 &&
           isAtRest(islands, bodies, object);
}

void DestructionWorld::Impl::afterRelease(uint32_t object, bool wasAtRest) {
    if (wasAtRest) restWhatIsBorne(world, islands, bodies, object);
    bodies.released().settle();
}

DestructionWorld::DestructionWorld(btDynamicsWorld& world, const WorldOptions& options)
    : impl_(std::make_unique<Impl>(world, options)) {}

DestructionWorld::~DestructionWorld() = default;

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
        const bool isHeld = isWhole && impl.holds(o) == Impl::Hold::toStatic;
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

bool DestructionWorld::freeze(ObjectId object, uint32_t fragment) {
    const uint32_t island = impl_->find(object, fragment);
    if (island == UINT32_MAX) return false;
    btRigidBody& body = impl_->bodies.body(island);
    if (!body.isStaticOrKinematicObject()) putToSleep(body);
    return true;
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
