// SPDX-License-Identifier: MIT
#include "shot.h"

#include <btBulletDynamicsCommon.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <numbers>

#include "sherd/runtime/bullet/destruction_world.h"

namespace sherd::samples {
namespace {

constexpr float kGravity = 9.81F;

btVector3 toBullet(const glm::vec3& v) {
    return {v.x, v.y, v.z};
}

/// The lowest point of the object's colliders, as turned by the pose.
float lowestCollider(const Asset& asset, const RigidPose& pose) {
    const FractureSet& set = asset.set();
    float lowest = std::numeric_limits<float>::max();
    const Range hulls = set.fragments[0].hulls;
    for (uint32_t h = hulls.first; h < hulls.first + hulls.count; ++h) {
        const ConvexHull& hull = set.hulls[h];
        for (uint32_t p = hull.points.first; p < hull.points.first + hull.points.count; ++p) {
            lowest = std::min(lowest, (pose.rotation * set.hullPoints[p]).y - hull.margin);
        }
    }
    return lowest;
}

/// The object stands on the floor at the origin; the ball comes along its thinner horizontal axis.
/// It is its collider that must touch the floor: a heavy thing that drops a centimetre may break.
Stage measure(const Asset& asset, RigidPose& pose) {
    glm::vec3 low(std::numeric_limits<float>::max());
    glm::vec3 high(std::numeric_limits<float>::lowest());
    const FractureGeometry& geometry = asset.geometry();
    for (const DrawRange& range : asset.drawRanges(0)) {
        for (uint32_t i = range.indices.first; i < range.indices.first + range.indices.count; ++i) {
            const glm::vec3 p = pose.rotation * geometry.positions[geometry.indices[i]];
            low = glm::min(low, p);
            high = glm::max(high, p);
        }
    }
    const float lowest = lowestCollider(asset, pose);
    pose.translation = -glm::vec3((low.x + high.x) / 2, lowest, (low.z + high.z) / 2);
    Stage stage;
    stage.low = low + pose.translation;
    stage.high = high + pose.translation;
    const glm::vec3 size = high - low;
    stage.from = size.z < 0.9F * size.x ? glm::vec3(0, 0, 1) : glm::vec3(1, 0, 0);
    stage.hit = glm::vec3(0, 0.55F * size.y, 0) + stage.from * (0.5F * glm::dot(size, stage.from));
    return stage;
}

}  // namespace

float Stage::diagonal() const {
    return glm::distance(low, high);
}

class Shot::Impl {
  public:
    explicit Impl(const ShotOptions& options)
        : dispatcher_(&configuration_),
          world_(&dispatcher_, &broadphase_, &solver_, &configuration_),
          floorShape_(btVector3(0, 1, 0), 0),
          options_(options) {
        world_.setGravity({0, -kGravity, 0});
        WorldOptions destruction;
        destruction.drive = Drive::manual;
        destruction_ = std::make_unique<DestructionWorld>(world_, destruction);
    }

    ~Impl() {
        destruction_.reset();
        if (ball_) world_.removeRigidBody(ball_.get());
        if (floor_) world_.removeRigidBody(floor_.get());
    }

    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;

    Result<void> build(const std::shared_ptr<const Asset>& asset) {
        RigidPose pose;
        pose.rotation = asset->set().restPose.rotation;
        stage_ = measure(*asset, pose);
        floor_ = std::make_unique<btRigidBody>(
            btRigidBody::btRigidBodyConstructionInfo(0, nullptr, &floorShape_));
        floor_->setFriction(0.9F);
        world_.addRigidBody(floor_.get());
        const Result<ObjectId> object = destruction_->spawn(asset, pose);
        if (!object) return tl::unexpected(object.error());
        throwBall();
        return {};
    }

    void step(float dt) {
        world_.stepSimulation(dt, 0);
        destruction_->afterStep(dt);
        for (const BreakEvent& event : destruction_->events()) breaks_.push_back(event);
    }

    [[nodiscard]] glm::mat4 ballMatrix() const {
        btTransform transform = ball_->getWorldTransform();
        glm::mat4 matrix(1.0F);
        std::array<btScalar, 16> values{};
        transform.getOpenGLMatrix(values.data());
        for (int i = 0; i < 16; ++i) matrix[i / 4][i % 4] = values[static_cast<size_t>(i)];
        return glm::scale(matrix, glm::vec3(ballRadius_));
    }

    [[nodiscard]] float ballEnergy() const { return 0.5F * ballMass_ * speed_ * speed_; }
    [[nodiscard]] const Stage& stage() const { return stage_; }
    [[nodiscard]] std::span<const FragmentPose> poses() const { return destruction_->poses(); }
    [[nodiscard]] const std::vector<BreakEvent>& breaks() const { return breaks_; }

  private:
    /// Aimed so that it touches the object at hitTime, gravity allowed for.
    void throwBall() {
        ballRadius_ = options_.ballSize * stage_.diagonal();
        ballMass_ =
            options_.ballDensity * 4 / 3 * std::numbers::pi_v<float> * std::pow(ballRadius_, 3.0F);
        // Larger things are met faster, so that each shot takes as long to look at.
        speed_ = options_.speed > 0 ? options_.speed : 8.5F * std::sqrt(stage_.diagonal());
        ballShape_ = std::make_unique<btSphereShape>(ballRadius_);
        btVector3 inertia(0, 0, 0);
        ballShape_->calculateLocalInertia(ballMass_, inertia);
        ball_ = std::make_unique<btRigidBody>(btRigidBody::btRigidBodyConstructionInfo(
            ballMass_, nullptr, ballShape_.get(), inertia));
        const float t = options_.hitTime;
        const glm::vec3 target = stage_.hit + stage_.from * ballRadius_;
        const glm::vec3 arrival = -stage_.from * speed_;
        const glm::vec3 start = target - arrival * t;
        ball_->setWorldTransform(btTransform(btQuaternion::getIdentity(), toBullet(start)));
        ball_->setLinearVelocity(toBullet(arrival + glm::vec3(0, 0.5F * kGravity * t, 0)));
        ball_->setFriction(0.5F);
        ball_->setRollingFriction(0.01F);
        ball_->setSpinningFriction(0.01F);
        ball_->setRestitution(0.1F);
        ball_->setDamping(0, 0.1F);
        // A fast ball must not pass through a thin skin between two substeps.
        ball_->setCcdMotionThreshold(ballRadius_ * 0.5F);
        ball_->setCcdSweptSphereRadius(ballRadius_ * 0.6F);
        world_.addRigidBody(ball_.get());
    }

    btDefaultCollisionConfiguration configuration_;
    btCollisionDispatcher dispatcher_;
    btDbvtBroadphase broadphase_;
    btSequentialImpulseConstraintSolver solver_;
    btDiscreteDynamicsWorld world_;
    btStaticPlaneShape floorShape_;
    ShotOptions options_;
    std::unique_ptr<btRigidBody> floor_;
    std::unique_ptr<btSphereShape> ballShape_;
    std::unique_ptr<btRigidBody> ball_;
    std::unique_ptr<DestructionWorld> destruction_;
    Stage stage_;
    std::vector<BreakEvent> breaks_;
    float ballRadius_ = 0;
    float ballMass_ = 0;
    float speed_ = 0;
};

Result<std::unique_ptr<Shot>> Shot::create(const std::shared_ptr<const Asset>& asset,
                                           const ShotOptions& options) {
    auto impl = std::make_unique<Impl>(options);
    const Result<void> built = impl->build(asset);
    if (!built) return tl::unexpected(built.error());
    return std::unique_ptr<Shot>(new Shot(std::move(impl)));
}

Shot::Shot(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Shot::~Shot() = default;

void Shot::step(float dt) {
    impl_->step(dt);
}

const Stage& Shot::stage() const {
    return impl_->stage();
}

std::span<const FragmentPose> Shot::poses() const {
    return impl_->poses();
}

const std::vector<BreakEvent>& Shot::breaks() const {
    return impl_->breaks();
}

glm::mat4 Shot::ballMatrix() const {
    return impl_->ballMatrix();
}

float Shot::ballEnergy() const {
    return impl_->ballEnergy();
}

}  // namespace sherd::samples
