// SPDX-License-Identifier: MIT
// Pieces as they are baked, of several convex parts each, in a plain Bullet world: what any game
// makes of the file without Sherd's runtime.
#include <doctest/doctest.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "impact/bullet_world.h"
#include "sherd/baker/bake.h"
#include "support/random_solids.h"
#include "support/solid_meshes.h"

using namespace sherd;
using namespace sherd::test;

namespace {

/// Courses that meet in battlements, cut by upright joints: pieces that reach into each other, none
/// of them convex.
FracturePlan battlements(int columns, int rows) {
    auto map = std::make_shared<FractureMap>();
    map->lines.emplace_back().points = {
        {-0.1, -0.1}, {1.1, -0.1}, {1.1, 1.1}, {-0.1, 1.1}, {-0.1, -0.1}};
    for (int row = 1; row < rows; ++row) {
        FractureMap::Line& line = map->lines.emplace_back();
        const double at = static_cast<double>(row) / rows, deep = 0.15 / rows;
        line.points.emplace_back(-0.1, at + deep);
        for (int step = 0; step < 2 * columns; ++step) {  // two in each column, beside the joints
            const double along = (step + 0.5) / (2 * columns),
                         before = step % 2 == 0 ? deep : -deep;
            line.points.emplace_back(along, at + before);
            line.points.emplace_back(along, at - before);
        }
        line.points.emplace_back(1.1, at + deep);
    }
    for (int column = 1; column < columns; ++column) {
        const double at = static_cast<double>(column) / columns;
        map->lines.emplace_back().points = {{at, -0.1}, {at, 1.1}};
    }
    FracturePlan plan;
    VolumeCut& cut = plan.cuts.emplace_back();
    cut.kind = VolumeCut::Kind::map;
    cut.drawing = std::move(map);
    return plan;
}

/// A wall of 4 x 3 x 1 sizes on the ground.
FractureSet bakedWall(float size) {
    const Solid wall = boxSolid(size * glm::vec3(-2, 0, -0.5F), size * glm::vec3(2, 3, 0.5F));
    Recipe recipe;
    recipe.physics.density = 2000;
    recipe.physics.hullMargin = 0.01 * size;
    Result<BakedObject> baked = bakeObject(meshOf(wall), battlements(4, 3), recipe, 0);
    if (!baked) FAIL(baked.error().message);
    return std::move(baked->set);
}

btVector3 toBt(const glm::vec3& v) {
    return {v.x, v.y, v.z};
}

/// All leaves at rest where they were baked, each a compound of its convex parts about its centre
/// of mass.
class RestingPieces {
  public:
    RestingPieces(const FractureSet& set, btDiscreteDynamicsWorld& world) : world_(world) {
        for (const Fragment& fragment : set.fragments)
            if (fragment.children.count == 0) add(set, fragment);
    }
    ~RestingPieces() {
        for (const auto& body : bodies_) world_.removeRigidBody(body.get());
    }
    RestingPieces(const RestingPieces&) = delete;
    RestingPieces& operator=(const RestingPieces&) = delete;

    size_t count() const { return bodies_.size(); }
    size_t ofSeveralParts() const {
        return static_cast<size_t>(
            std::count_if(compounds_.begin(), compounds_.end(),
                          [](const auto& compound) { return compound->getNumChildShapes() > 1; }));
    }
    float fastest() const {
        btScalar speed = 0;
        for (const auto& body : bodies_)
            speed = std::max(speed, body->getLinearVelocity().length());
        return speed;
    }
    float fastestSpin() const {
        btScalar speed = 0;
        for (const auto& body : bodies_)
            speed = std::max(speed, body->getAngularVelocity().length());
        return speed;
    }
    /// How far any has moved.
    float farthest() const {
        btScalar way = 0;
        for (size_t i = 0; i < bodies_.size(); ++i)
            way = std::max(way, (bodies_[i]->getCenterOfMassPosition() - places_[i]).length());
        return way;
    }

  private:
    void add(const FractureSet& set, const Fragment& fragment) {
        const glm::quat& q = fragment.inertiaOrientation;
        const btTransform frame(btQuaternion(q.x, q.y, q.z, q.w).normalized(),
                                toBt(fragment.centerOfMass));
        const btTransform toBody = frame.inverse();
        auto compound = std::make_unique<btCompoundShape>();
        compound->setMargin(0);  // the parts have their own
        for (uint32_t h = 0; h < fragment.hulls.count; ++h) {
            const ConvexHull& hull = set.hulls[fragment.hulls.first + h];
            auto part = std::make_unique<btConvexHullShape>();
            for (uint32_t p = 0; p < hull.points.count; ++p)
                part->addPoint(toBody * toBt(set.hullPoints[hull.points.first + p]), false);
            part->setMargin(hull.margin);
            part->recalcLocalAabb();
            compound->addChildShape(btTransform::getIdentity(), part.get());
            parts_.push_back(std::move(part));
        }
        btRigidBody::btRigidBodyConstructionInfo info(fragment.mass, nullptr, compound.get(),
                                                      toBt(fragment.inertiaDiagonal));
        info.m_startWorldTransform = frame;
        info.m_friction = fragment.friction;
        info.m_restitution = fragment.restitution;
        bodies_.push_back(std::make_unique<btRigidBody>(info));
        // Sleep would hide what moves slowly.
        bodies_.back()->setActivationState(DISABLE_DEACTIVATION);
        world_.addRigidBody(bodies_.back().get());
        places_.push_back(frame.getOrigin());
        compounds_.push_back(std::move(compound));
    }

    btDiscreteDynamicsWorld& world_;
    std::vector<std::unique_ptr<btConvexHullShape>> parts_;
    std::vector<std::unique_ptr<btCompoundShape>> compounds_;
    std::vector<std::unique_ptr<btRigidBody>> bodies_;
    std::vector<btVector3> places_;
};

}  // namespace

TEST_CASE("baked pieces of several convex parts that clasp each other stay at rest") {
    for (const float size : {0.1F, 1.0F, 10.0F}) {
        CAPTURE(size);
        const FractureSet set = bakedWall(size);
        BulletWorld bullet;
        const RestingPieces pieces(set, bullet.world);
        CHECK(pieces.count() == 12);
        CHECK(pieces.ofSeveralParts() >= 8);
        for (int i = 0; i < 60; ++i) bullet.step();
        CHECK(pieces.fastest() < 1e-3F * size);
        CHECK(pieces.fastestSpin() < 1e-3F);
        CHECK(pieces.farthest() < 1e-3F * size);
    }
}

TEST_CASE("baked pieces of several convex parts stay at rest when the runtime releases them") {
    BulletWorld bullet;
    DestructionWorld destruction(bullet.world);
    const auto asset = Asset::fromFractureSet(bakedWall(1)).value();
    const ObjectId wall = destruction.spawn(asset, at(3, 2, 1)).value();
    REQUIRE(destruction.breakFragment(wall));
    CHECK(destruction.ignoredPairCount() == 0);
    for (int i = 0; i < 60; ++i) bullet.step();
    for (const FragmentPose& pose : destruction.poses())
        CHECK(glm::length(pose.pose.translation - glm::vec3(3, 2, 1)) < 1e-3F);
}

// Larger pieces than some centimetres: at 60 steps a second Bullet does not hold up flat bricks of
// 10 cm either, whatever their colliders.
TEST_CASE("a baked wall of pieces of several convex parts stands on the ground") {
    for (const float size : {0.5F, 1.0F, 10.0F}) {
        CAPTURE(size);
        const FractureSet set = bakedWall(size);
        BulletWorld bullet(btVector3(0, -10, 0));
        bullet.addGround(0);
        const RestingPieces pieces(set, bullet.world);
        for (int i = 0; i < 240; ++i) bullet.step();
        CHECK(pieces.farthest() < 0.04F * size);
        CHECK(pieces.fastest() < 0.04F);
    }
}
