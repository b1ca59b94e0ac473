// SPDX-License-Identifier: MIT
#include "bullet/body_store.h"

#include <algorithm>

#include "bullet/convert.h"
#include "core/mass_properties.h"

namespace sherd {

BodyStore::~BodyStore() {
    for (uint32_t i = 0; i < islands_.size(); ++i) {
        if (islands_[i].body) removeBody(i);
    }
}

std::shared_ptr<FragmentShapes> BodyStore::shapesOf(const std::shared_ptr<const Asset>& asset) {
    for (const auto& shapes : shapes_) {
        if (shapes->asset() == asset) return shapes;
    }
    shapes_.push_back(std::make_shared<FragmentShapes>(asset));
    return shapes_.back();
}

uint32_t BodyStore::takeSlot() {
    if (freeIslands_.empty()) {
        islands_.emplace_back();
        return uint32_t(islands_.size() - 1);
    }
    const uint32_t slot = freeIslands_.back();
    freeIslands_.pop_back();
    return slot;
}

ObjectId BodyStore::spawn(const std::shared_ptr<const Asset>& asset, const RigidPose& pose,
                          const SpawnOptions& options) {
    auto shapes = shapesOf(asset);
    uint32_t index = uint32_t(objects_.size());
    if (freeObjects_.empty()) {
        objects_.emplace_back();
    } else {
        index = freeObjects_.back();
        freeObjects_.pop_back();
    }
    Object& object = objects_[index];
    object.shapes = std::move(shapes);
    object.structure = std::make_unique<Structure>(asset);
    object.options = options;
    const uint32_t slot = takeSlot();
    IslandBody& island = islands_[slot];
    island.object = index;
    island.fragments.assign(1, 0);
    island.bornAt = -HUGE_VAL;
    island.pose = island.previous = pose;
    island.isAnchored = asset->graph().isAnchored(0);
    const bool isFixed = !options.dynamic || island.isAnchored;
    makeBody(slot, isFixed);
    if (!isFixed) {
        island.body->setLinearVelocity(toBullet(options.linearVelocity));
        island.body->setAngularVelocity(toBullet(options.angularVelocity));
    }
    object.bodies.assign(1, slot);
    return idOf(index);
}

void BodyStore::remove(uint32_t index) {
    Object& object = objects_[index];
    for (const uint32_t island : object.bodies) removeBody(island);
    // Backwards, so that the slots are handed out again in the order they were given up.
    freeIslands_.insert(freeIslands_.end(), object.bodies.rbegin(), object.bodies.rend());
    object.bodies.clear();
    object.shapes.reset();
    object.structure.reset();
    ++object.generation;
    freeObjects_.push_back(index);
}

/// What the island's fragments are as one body; makes its shape and sets its frame.
btRigidBody::btRigidBodyConstructionInfo BodyStore::describe(IslandBody& island, bool isFixed) {
    const FragmentShapes& shapes = *objects_[island.object].shapes;
    const Asset& asset = *shapes.asset();
    const Fragment& first = asset.fragment(island.fragments.front());
    btCollisionShape* shape = nullptr;
    double mass = double(first.mass);
    btVector3 inertia = toBullet(first.inertiaDiagonal);
    island.shape.reset();
    if (island.fragments.size() == 1) {
        shape = shapes.shape(island.fragments.front());
        island.frame = shapes.bodyFrame(island.fragments.front());
    } else {
        MassProperties sum;
        for (const uint32_t fragment : island.fragments)
            sum = sum + massOf(asset.fragment(fragment));
        const PrincipalInertia principal = principalInertia(sum);
        mass = sum.mass;
        inertia = toBullet(principal.diagonal);
        island.frame = btTransform(toBullet(principal.orientation).normalized(),
                                   toBullet(glm::vec3(sum.center)));
        island.shape = std::make_unique<IslandShape>(shapes, island.fragments, island.frame);
        shape = island.shape->shape();
    }
    btRigidBody::btRigidBodyConstructionInfo info(isFixed ? 0 : btScalar(mass), nullptr, shape,
                                                  isFixed ? btVector3(0, 0, 0) : inertia);
    info.m_startWorldTransform = toBullet(island.pose) * island.frame;
    info.m_friction = first.friction;
    info.m_restitution = first.restitution;
    return info;
}

void BodyStore::addToWorld(IslandBody& island) {
    const SpawnOptions& options = objects_[island.object].options;
    if (options.collisionGroup == 0 && options.collisionMask == 0) {
        world_.addRigidBody(island.body.get());
    } else {
        world_.addRigidBody(island.body.get(), options.collisionGroup, options.collisionMask);
    }
}

void BodyStore::makeBody(uint32_t index, bool isFixed) {
    IslandBody& island = islands_[index];
    island.body = std::make_unique<btRigidBody>(describe(island, isFixed));
    island.body->setUserIndex3(int(index));
    island.seen = island.body->getWorldTransform();
    island.isStill = false;
    addToWorld(island);
    ++bodyCount_;
    posesListed_ = false;
}

/// The same body, with another shape, mass and centre. Out of the world and in again: Bullet sorts
/// bodies into fixed and moving ones when they are added, and holds contacts of the old shape.
void BodyStore::reshape(uint32_t index, bool isFixed) {
    IslandBody& island = islands_[index];
    btRigidBody& body = *island.body;
    const bool isInWorld = body.isInWorld();
    if (isInWorld) world_.removeRigidBody(&body);
    const std::unique_ptr<IslandShape> old = std::move(island.shape);
    const auto info = describe(island, isFixed);
    body.setCollisionShape(info.m_collisionShape);
    body.setWorldTransform(info.m_startWorldTransform);
    body.setInterpolationWorldTransform(info.m_startWorldTransform);
    island.seen = info.m_startWorldTransform;
    island.isStill = false;
    body.setMassProps(info.m_mass, info.m_localInertia);
    if (isFixed) {
        body.setLinearVelocity(btVector3(0, 0, 0));
        body.setAngularVelocity(btVector3(0, 0, 0));
    }
    body.updateInertiaTensor();
    body.setFriction(info.m_friction);
    body.setRestitution(info.m_restitution);
    if (isInWorld) addToWorld(island);
    posesListed_ = false;
}

void BodyStore::removeBody(uint32_t index) {
    IslandBody& island = islands_[index];
    --bodyCount_;
    if (island.body->isInWorld()) world_.removeRigidBody(island.body.get());
    island.body.reset();
    island.shape.reset();
    posesListed_ = false;
}

BodyStore::Change BodyStore::regroup(uint32_t index) {
    IslandBody& island = islands_[index];
    const Structure& structure = *objects_[island.object].structure;
    std::vector<uint32_t>& fragments = island.fragments;
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
    std::sort(fragments.begin(), fragments.end());
    groups_.find(structure, fragments);
    const auto groups = groups_.islands();
    if (groups.size() > 1 || island.isAnchored != groups[0].anchored) change_ = Change::apart;
    return change_;
}

std::span<const uint32_t> BodyStore::split(uint32_t index, double time, bool inStep) {
    updated_.assign(1, index);
    if (change_ == Change::none) return updated_;
    const bool isSplit = change_ == Change::apart;
    const std::span<const IslandFinder::Island> groups = groups_.islands();
    const uint32_t objectIndex = islands_[index].object;
    const auto largest =
        size_t(std::max_element(groups.begin(), groups.end(),
                                [](const auto& x, const auto& y) { return x.mass < y.mass; }) -
               groups.begin());
    const btRigidBody& whole = *islands_[index].body;
    const btVector3 center = whole.getCenterOfMassPosition();
    const btVector3 linear = whole.getLinearVelocity();
    const btVector3 angular = whole.getAngularVelocity();
    const auto giveMotion = [&](btRigidBody& body) {
        if (body.isStaticObject()) return;
        body.setLinearVelocity(linear + angular.cross(body.getCenterOfMassPosition() - center));
        body.setAngularVelocity(angular);
    };
    const auto give = [&](IslandBody& island, size_t group) {
        const std::span<const uint32_t> fragments = groups_.fragmentsOf(groups[group]);
        island.fragments.assign(fragments.begin(), fragments.end());
        island.isAnchored = groups[group].anchored;
    };
    for (size_t g = 0; g < groups.size(); ++g) {
        if (g == largest) continue;
        const uint32_t slot = takeSlot();
        IslandBody& island = islands_[slot];
        island.object = objectIndex;
        give(island, g);
        island.bornAt = time;
        island.pose = islands_[index].pose;
        island.previous = islands_[index].previous;
        makeBody(slot, island.isAnchored);
        giveMotion(*island.body);
        // Bullet applies gravity once before all substeps of a step and clears it after the last.
        if (inStep) island.body->applyGravity();
        updated_.push_back(slot);
    }
    IslandBody& kept = islands_[index];
    give(kept, largest);
    if (isSplit) kept.bornAt = time;
    // A body that stands by its spawn option alone stands until something comes off.
    const bool isFixed = kept.isAnchored || (!isSplit && kept.body->isStaticObject());
    const btVector3 weight = kept.body->getGravity() * kept.body->getMass();
    reshape(index, isFixed);
    giveMotion(*kept.body);
    if (inStep && !isFixed)
        kept.body->applyCentralForce(kept.body->getGravity() * kept.body->getMass() - weight);

    std::vector<uint32_t>& bodies = objects_[objectIndex].bodies;
    bodies.insert(bodies.end(), updated_.begin() + 1, updated_.end());
    std::sort(bodies.begin(), bodies.end(), [&](uint32_t x, uint32_t y) {
        return islands_[x].fragments.front() < islands_[y].fragments.front();
    });
    return updated_;
}

void BodyStore::readPoses() {
    for (IslandBody& island : islands_) {
        if (!island.body) continue;
        const btTransform& now = island.body->getWorldTransform();
        if (now == island.seen) {  // what sleeps costs a look
            if (!island.isStill) posesListed_ = false;
            island.previous = island.pose;
            island.isStill = true;
            continue;
        }
        island.previous = island.pose;
        island.pose = toPose(now * island.frame.inverse());
        island.seen = now;
        island.isStill = false;
        posesListed_ = false;
    }
}

std::span<const FragmentPose> BodyStore::poses() {
    if (posesListed_) return poses_;
    poses_.clear();
    for (uint32_t o = 0; o < objects_.size(); ++o) {
        const size_t first = poses_.size();
        for (const uint32_t b : objects_[o].bodies) {
            const IslandBody& island = islands_[b];
            for (const uint32_t fragment : island.fragments)
                poses_.push_back(
                    {idOf(o), &objects_[o].asset(), fragment, island.pose, island.previous});
        }
        std::sort(
            poses_.begin() + std::ptrdiff_t(first), poses_.end(),
            [](const FragmentPose& x, const FragmentPose& y) { return x.fragment < y.fragment; });
    }
    posesListed_ = true;
    return poses_;
}

bool BodyStore::pin(uint32_t object, uint32_t fragment, bool pinned) {
    if (findIsland(object, fragment) == UINT32_MAX) return false;
    Structure& structure = *objects_[object].structure;
    const Range leaves = structure.graph().leavesOf(fragment);
    for (uint32_t leaf = leaves.first; leaf < leaves.first + leaves.count; ++leaf)
        structure.pin(leaf, pinned);
    return true;
}

void BodyStore::replaceBodies(uint32_t index, ObjectSnapshot&& snapshot) {
    Object& object = objects_[index];
    for (const uint32_t island : object.bodies) removeBody(island);
    freeIslands_.insert(freeIslands_.end(), object.bodies.rbegin(), object.bodies.rend());
    object.bodies.clear();
    *object.structure = std::move(*snapshot.structure);
    for (BodySnapshot& from : snapshot.bodies) {
        const uint32_t slot = takeSlot();
        IslandBody& island = islands_[slot];
        island.object = index;
        island.fragments = std::move(from.fragments);
        island.isAnchored = from.isAnchored;
        island.bornAt = from.bornAt;
        island.pose = from.pose;
        island.previous = from.previous;
        makeBody(slot, from.isFixed);
        btRigidBody& body = *island.body;
        body.setWorldTransform(from.transform);
        body.setInterpolationWorldTransform(from.transform);
        island.seen = from.transform;
        body.setLinearVelocity(from.linear);
        body.setAngularVelocity(from.angular);
        body.setInterpolationLinearVelocity(from.linear);
        body.setInterpolationAngularVelocity(from.angular);
        body.updateInertiaTensor();
        body.forceActivationState(from.activation);
        body.setDeactivationTime(from.quietFor);
        if (body.isInWorld()) world_.updateSingleAabb(&body);
        object.bodies.push_back(slot);
    }
}

uint32_t BodyStore::pinLeaves(
    uint32_t index, const std::function<bool(btCollisionShape&, const btTransform&)>& wanted) {
    const Object& object = objects_[index];
    Structure& structure = *object.structure;
    uint32_t count = 0;
    for (const uint32_t b : object.bodies) {
        const IslandBody& island = islands_[b];
        const btTransform frame = island.body->getWorldTransform() * island.frame.inverse();
        for (const uint32_t fragment : island.fragments) {
            const Range leaves = structure.graph().leavesOf(fragment);
            for (uint32_t leaf = leaves.first; leaf < leaves.first + leaves.count; ++leaf) {
                const uint32_t f = structure.graph().fragmentOfLeaf(leaf);
                if (!wanted(*object.shapes->shape(f), frame * object.shapes->bodyFrame(f)))
                    continue;
                structure.pin(leaf, true);
                ++count;
            }
        }
    }
    return count;
}

void BodyStore::throwFrom(const glm::vec3& point, float radius, float impulsePerArea) {
    for (const IslandBody& island : islands_) {
        if (!island.body || island.body->isStaticObject()) continue;
        const btVector3 away = island.body->getCenterOfMassPosition() - toBullet(point);
        const btScalar distance = away.length();
        if (!(distance < radius) || !(distance > 0)) continue;
        btVector3 center;
        btScalar size = 0;
        island.body->getCollisionShape()->getBoundingSphere(center, size);
        const btScalar area = SIMD_PI * size * size;
        island.body->activate();
        island.body->applyCentralImpulse(away / distance * impulsePerArea * area *
                                         (1 - distance / radius));
    }
}

bool BodyStore::isAlive(ObjectId id) const {
    return id.index < objects_.size() && objects_[id.index].generation == id.generation &&
           objects_[id.index].shapes != nullptr;
}

ObjectId BodyStore::idOf(uint32_t object) const {
    return {object, objects_[object].generation};
}

uint32_t BodyStore::findIsland(uint32_t object, uint32_t fragment) const {
    for (const uint32_t island : objects_[object].bodies) {
        const std::vector<uint32_t>& fragments = islands_[island].fragments;
        if (std::binary_search(fragments.begin(), fragments.end(), fragment)) return island;
    }
    return UINT32_MAX;
}

// The slot number on the body is only a hint: the game's own bodies may carry any number there.
uint32_t BodyStore::islandOf(const btCollisionObject& body) const {
    const auto slot = uint32_t(body.getUserIndex3());
    return slot < islands_.size() && islands_[slot].body.get() == &body ? slot : UINT32_MAX;
}

uint32_t BodyStore::fragmentOf(uint32_t index, int child) const {
    const IslandBody& island = islands_[index];
    return island.shape && child >= 0 ? island.shape->fragmentOf(child) : island.fragments.front();
}

}  // namespace sherd
