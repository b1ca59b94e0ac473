// SPDX-License-Identifier: MIT
#include "sherd/runtime/island_world.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "core/budget.h"
#include "core/mass_properties.h"
#include "core/rigid_pose.h"

namespace sherd {

IslandWorld::IslandWorld(BodyTable& bodies, uint32_t maxPendingEvents)
    : bodies_(bodies),
      breaks_(maxPendingEvents),
      impacts_(maxPendingEvents),
      born_(maxPendingEvents),
      removals_(maxPendingEvents),
      merger_(std::make_unique<IslandMerger>()) {}

IslandWorld::~IslandWorld() = default;

uint32_t IslandWorld::takeIsland(const Places& places) {
    auto slot = uint32_t(islands_.size());
    if (freeIslands_.empty()) {
        places_.resize(slot + 1);  // first: there must be enough of them, also where memory ends
        islands_.emplace_back();
    } else {
        slot = freeIslands_.back();
        freeIslands_.pop_back();
    }
    places_[slot] = places;
    return slot;
}

ObjectId IslandWorld::spawn(std::shared_ptr<const Asset> asset, const RigidPose& pose,
                            const DamageOptions& damage, bool dynamic, const BodyMotion& motion) {
    uint32_t index = uint32_t(objects_.size());
    if (freeObjects_.empty()) {
        objects_.emplace_back();
    } else {
        index = freeObjects_.back();
        freeObjects_.pop_back();
    }
    Object& object = objects_[index];
    object.asset = std::move(asset);
    if (object.structure) {
        object.structure->renew(object.asset);
    } else {
        object.structure = makePooled<Structure>(object.asset);
    }
    object.damage = damage;
    object.loads.clear();
    leastEnergy_ = std::min(leastEnergy_, damage.minimumEnergy);
    const uint32_t slot = takeIsland({pose, pose});
    Island& island = islands_[slot];
    island.object = index;
    island.fragments.assign(1, 0);
    island.mass = double(object.asset->fragment(0).mass);
    island.isAnchored = object.asset->graph().isAnchored(0);
    island.isFixed = !dynamic || island.isAnchored;
    island.bornAt = -HUGE_VAL;
    object.islands.assign(1, slot);
    IslandBody body = describe(slot);
    body.motion = motion;
    create(body);
    return idOf(index);
}

void IslandWorld::forgetIsland(uint32_t island) {
    islands_[island].isAlive = false;
    --islandCount_;
    // Its number may be given to another object's.
    if (island == stressed_) isStressNew_ = true;
    std::erase(strained_, island);
    std::erase(fading_, island);
}

void IslandWorld::removeIslands(uint32_t index) {
    Object& object = objects_[index];
    for (const uint32_t island : object.islands) {
        bodies_.remove(island);
        forgetIsland(island);
    }
    // Backwards, so that the slots are handed out again in the order they were given up.
    freeIslands_.insert(freeIslands_.end(), object.islands.rbegin(), object.islands.rend());
    object.islands.clear();
    object.heaviest = UINT32_MAX;
    poses_.noteRegrouped(index);
}

void IslandWorld::remove(uint32_t index) {
    Object& object = objects_[index];
    removeIslands(index);
    object.asset.reset();
    object.structure->renew(nullptr);
    ++object.generation;
    freeObjects_.push_back(index);
}

/// All but its motion, which the caller knows; the frame is worked out anew.
IslandBody IslandWorld::describe(uint32_t index) const {
    const Island& island = islands_[index];
    const Asset& asset = *objects_[island.object].asset;
    const Fragment& first = asset.fragment(island.fragments.front());
    IslandBody body;
    body.island = index;
    body.object = idOf(island.object);
    body.asset = &asset;
    body.fragments = island.fragments;
    body.friction = first.friction;
    body.restitution = first.restitution;
    float mass = first.mass;
    glm::vec3 inertia = first.inertiaDiagonal;
    body.frame = {first.centerOfMass, glm::normalize(first.inertiaOrientation)};
    if (island.fragments.size() > 1) {
        MassMoments moments;
        for (const uint32_t fragment : island.fragments) moments += asset.massMoments(fragment);
        const MassProperties sum =
            propertiesOf(moments, glm::dvec3(asset.fragment(0).centerOfMass));
        const PrincipalInertia principal = principalInertia(sum);
        mass = float(sum.mass);
        inertia = principal.diagonal;
        body.frame = {glm::vec3(sum.center), principal.orientation};
    }
    body.mass = island.isFixed ? 0 : mass;
    body.inertia = island.isFixed ? glm::vec3(0.0F) : inertia;
    return body;
}

/// Makes the body described, where the island is, or at `bodyPose`; one that is fixed does not
/// move.
void IslandWorld::create(IslandBody body, const RigidPose* bodyPose) {
    Island& island = islands_[body.island];
    island.isAlive = true;
    island.keptAt = -HUGE_VAL;
    island.fadingSince = HUGE_VAL;
    objects_[island.object].heaviest = UINT32_MAX;
    ++islandCount_;
    island.frame = body.frame;
    if (island.isFixed) body.motion = {};
    body.motion.pose = bodyPose ? *bodyPose : placesOf(body.island).now * body.frame;
    bodies_.create(body);
    poses_.noteRegrouped(island.object);
}

/// What may hang together no more.
std::span<const uint32_t> IslandWorld::disturbed(const Structure& structure) {
    disturbed_.clear();
    for (const uint32_t b : hit_.bonds) {
        const BondGraph::Bond& bond = structure.graph().bond(b);
        disturbed_.push_back(structure.fragmentAt(bond.a));
        if (bond.b != BondGraph::kWorld) disturbed_.push_back(structure.fragmentAt(bond.b));
    }
    for (const uint32_t opened : hit_.opened) {
        const Range children = structure.asset().fragment(opened).children;
        for (uint32_t c = children.first; c < children.first + children.count; ++c)
            if (structure.stands(c)) disturbed_.push_back(c);
    }
    return disturbed_;
}

IslandWorld::Change IslandWorld::regroup(uint32_t index, bool isLimited) {
    Island& island = islands_[index];
    const Structure& structure = *objects_[island.object].structure;
    Vector<uint32_t>& fragments = island.fragments;
    change_ = Change::none;
    for (size_t i = 0; i < fragments.size();) {
        if (structure.stands(fragments[i])) {
            ++i;
            continue;
        }
        change_ = Change::finer;
        const Range children = structure.asset().fragment(fragments[i]).children;
        fragments[i] = children.first;
        for (uint32_t c = 1; c < children.count; ++c) fragments.push_back(children.first + c);
    }
    if (change_ == Change::finer) std::sort(fragments.begin(), fragments.end());
    groups_.findAround(structure, fragments, disturbed(structure));
    if (isLimited) keepToBudget(index);
    const auto groups = groups_.islands();
    if (groups.size() > 1 || island.isAnchored != groups[0].anchored) change_ = Change::apart;
    return change_;
}

void IslandWorld::keepToBudget(uint32_t index) {
    const uint32_t allowed = std::min(budget_.bodies, std::max(budget_.awake, 1U));
    if (groups_.islands().size() - 1 <= allowed) return;
    Structure& structure = *objects_[islands_[index].object].structure;
    if (!merger_->limit(structure, groups_, allowed + 1, hit_)) return;
    // Some may have been closed again.
    Vector<uint32_t>& fragments = islands_[index].fragments;
    for (uint32_t& fragment : fragments)
        fragment = structure.fragmentAt(structure.graph().leavesOf(fragment).first);
    if (!std::is_sorted(fragments.begin(), fragments.end()))
        std::sort(fragments.begin(), fragments.end());
    fragments.erase(std::unique(fragments.begin(), fragments.end()), fragments.end());
    groups_.findAround(structure, fragments, disturbed(structure));
    if (hit_.opened.empty()) change_ = Change::none;
    if (structure.fragmentAt(structure.graph().leavesOf(hit_.struck).first) != hit_.struck)
        hit_.struck = structure.fragmentAt(structure.graph().leavesOf(hit_.struck).first);
}

std::span<const uint32_t> IslandWorld::split(uint32_t index, BreakEvent event) {
    split_.assign(1, index);
    if (change_ != Change::none) {
        bodies_.beforeSplit(index);
        const std::span<const IslandFinder::Island> groups = groups_.islands();
        const auto heaviest =
            size_t(std::max_element(groups.begin(), groups.end(),
                                    [](const auto& x, const auto& y) { return x.mass < y.mass; }) -
                   groups.begin());
        const bool isSplit = change_ == Change::apart;
        const BodyMotion whole = bodies_.motion(index);
        const Places places = placesOf(index);
        // A part moves as it did in the whole.
        const auto motionAt = [&](const glm::vec3& center) {
            BodyMotion motion;
            motion.linearVelocity =
                whole.linearVelocity +
                glm::cross(whole.angularVelocity, center - whole.pose.translation);
            motion.angularVelocity = whole.angularVelocity;
            return motion;
        };
        const auto give = [&](Island& island, size_t group) {
            const std::span<const uint32_t> fragments = groups_.fragmentsOf(groups[group]);
            island.fragments.assign(fragments.begin(), fragments.end());
            island.isAnchored = groups[group].anchored;
            island.mass = groups[group].mass;
        };
        const bool wasFixed = islands_[index].isFixed;
        const uint32_t from = islands_[index].fragments.front();
        for (size_t g = 0; g < groups.size(); ++g) {
            if (g == heaviest) continue;
            const uint32_t slot = takeIsland(places);
            Island& island = islands_[slot];
            island.object = islands_[index].object;
            island.bornAt = time_;
            give(island, g);
            island.isFixed = island.isAnchored;
            IslandBody body = describe(slot);
            const RigidPose pose = places.now * body.frame;
            body.motion = motionAt(pose.translation);
            create(body, &pose);
            body.motion.pose = pose;
            addIslandEvent(body, from);
            split_.push_back(slot);
        }
        Island& kept = islands_[index];
        give(kept, heaviest);
        if (isSplit) kept.bornAt = time_;
        // What stands without an anchor stands until something comes off.
        kept.isFixed = kept.isAnchored || (!isSplit && kept.isFixed);
        IslandBody body = describe(index);
        kept.frame = body.frame;
        body.motion.pose = places.now * body.frame;
        if (!kept.isFixed) {
            const RigidPose pose = body.motion.pose;
            body.motion = motionAt(pose.translation);
            body.motion.pose = pose;
        }
        bodies_.update(body);
        if (wasFixed && !kept.isFixed) addIslandEvent(body, body.fragments.front());
        bodies_.afterSplit(index, split_);
        for (const uint32_t i : split_) strain(i);
        poses_.noteRegrouped(kept.object);

        Vector<uint32_t>& islands = objects_[kept.object].islands;
        islands.insert(islands.end(), split_.begin() + 1, split_.end());
        std::sort(islands.begin(), islands.end(), [&](uint32_t x, uint32_t y) {
            return islands_[x].fragments.front() < islands_[y].fragments.front();
        });
        change_ = Change::none;
        const auto created = uint32_t(split_.size() - 1);
        budget_.bodies -= std::min(budget_.bodies, created);
        budget_.awake -= std::min(budget_.awake, created);
    }
    if (hit_.brokeSomething()) addEvent(event, index, uint32_t(split_.size()) - 1);
    hit_.clear();
    return split_;
}

void IslandWorld::replace(uint32_t index, Structure&& structure, Vector<SavedIsland>&& islands) {
    Object& object = objects_[index];
    removeIslands(index);
    *object.structure = std::move(structure);
    for (SavedIsland& from : islands) {
        const uint32_t slot = takeIsland(from.places);
        Island& island = islands_[slot];
        island.object = index;
        island.fragments = std::move(from.fragments);
        island.mass = 0;
        for (const uint32_t f : island.fragments)
            island.mass += double(object.asset->fragment(f).mass);
        island.isFixed = from.isFixed;
        island.isAnchored = from.isAnchored;
        island.bornAt = from.bornAt;
        object.islands.push_back(slot);
        IslandBody body = describe(slot);
        body.motion = from.motion;
        create(body, &from.motion.pose);
        islands_[slot].fadingSince = from.fadingSince;
        if (islands_[slot].isFading()) fading_.push_back(slot);
        strain(slot);
    }
}

void IslandWorld::moveTo(uint32_t index, const RigidPose& pose) {
    Places& places = places_[index];
    places.before = places.now;
    places.now = pose;
    poses_.noteMoved(islands_[index].object);
}

void IslandWorld::stayPut(uint32_t index) {
    places_[index].before = places_[index].now;
    poses_.noteMoved(islands_[index].object);
}

std::span<const FragmentPose> IslandWorld::poses() {
    bodies_.tellMoves();
    return poses_.list(*this);
}

std::span<const Range> IslandWorld::changedPoses() {
    bodies_.tellMoves();
    return poses_.takeChanges(*this);
}

void IslandWorld::follow(uint32_t island) {
    moveTo(island, bodies_.motion(island).pose * inverse(islands_[island].frame));
}

bool IslandWorld::isAlive(ObjectId id) const {
    return id.index < objects_.size() && objects_[id.index].generation == id.generation &&
           objects_[id.index].asset != nullptr;
}

ObjectId IslandWorld::idOf(uint32_t object) const {
    return {object, objects_[object].generation};
}

uint32_t IslandWorld::findIsland(uint32_t object, uint32_t fragment) const {
    for (const uint32_t island : objects_[object].islands) {
        const Vector<uint32_t>& fragments = islands_[island].fragments;
        if (std::binary_search(fragments.begin(), fragments.end(), fragment)) return island;
    }
    return UINT32_MAX;
}

}  // namespace sherd
