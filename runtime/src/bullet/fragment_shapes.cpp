// SPDX-License-Identifier: MIT
#include "bullet/fragment_shapes.h"

#include <algorithm>

#include "bullet/convert.h"

namespace sherd {
namespace {

std::unique_ptr<btConvexHullShape> makeHull(const FractureSet& set, const ConvexHull& hull,
                                            const btTransform& objectToBody) {
    auto shape = std::make_unique<btConvexHullShape>();
    for (uint32_t p = 0; p < hull.points.count; ++p) {
        const btVector3 point = objectToBody * toBullet(set.hullPoints[hull.points.first + p]);
        shape->addPoint(point, false);
    }
    // The points are baked shrunk by the margin: without setting it the shape would keep Bullet's
    // 4 cm. The box in the shape must be made after it, or it keeps the old margin.
    shape->setMargin(hull.margin);
    shape->recalcLocalAabb();
    return shape;
}

/// Empty, for so many hulls. They have margins of their own.
std::unique_ptr<btCompoundShape> makeCompound(size_t hulls) {
    constexpr size_t kTreeWorthwhile = 8;  // below, testing every child is cheaper than a tree
    auto compound = std::make_unique<btCompoundShape>(hulls > kTreeWorthwhile, int(hulls));
    compound->setMargin(0);
    return compound;
}

}  // namespace

FragmentShapes::FragmentShapes(std::shared_ptr<const Asset> asset, const Jobs& jobs)
    : asset_(std::move(asset)),
      compounds_(asset_->fragmentCount()),
      shapes_(asset_->fragmentCount()) {
    uint32_t hulls = 0;
    firstHull_.reserve(asset_->fragmentCount());
    for (uint32_t f = 0; f < asset_->fragmentCount(); ++f) {
        firstHull_.push_back(hulls);
        hulls += asset_->fragment(f).hulls.count;
    }
    hulls_.resize(hulls);
    // A job of some 0.1 ms each.
    constexpr uint32_t kFragmentsPerJob = 64;
    const auto makeSome = [](void* data, uint32_t job) {
        auto& self = *static_cast<FragmentShapes*>(data);
        const uint32_t end = std::min(self.asset_->fragmentCount(), (job + 1) * kFragmentsPerJob);
        for (uint32_t f = job * kFragmentsPerJob; f < end; ++f) self.make(f);
    };
    const uint32_t count = (asset_->fragmentCount() + kFragmentsPerJob - 1) / kFragmentsPerJob;
    if (jobs.run && count > 1) {
        jobs.run(jobs.user, count, makeSome, this);
    } else {
        for (uint32_t job = 0; job < count; ++job) makeSome(this, job);
    }
}

void FragmentShapes::make(uint32_t fragment) {
    const FractureSet& set = asset_->set();
    const Range range = set.fragments[fragment].hulls;
    const btTransform objectToBody = bodyFrame(fragment).inverse();
    for (uint32_t h = 0; h < range.count; ++h)
        hulls_[firstHull_[fragment] + h] = makeHull(set, set.hulls[range.first + h], objectToBody);
    if (range.count == 1) {
        shapes_[fragment] = hulls_[firstHull_[fragment]].get();
        return;
    }
    compounds_[fragment] = makeCompound(range.count);
    for (const auto& hull : hulls(fragment))
        compounds_[fragment]->addChildShape(btTransform::getIdentity(), hull.get());
    shapes_[fragment] = compounds_[fragment].get();
}

IslandShape::IslandShape(const FragmentShapes& shapes, std::span<const uint32_t> fragments,
                         const btTransform& bodyFrame) {
    for (const uint32_t fragment : fragments)
        fragments_.insert(fragments_.end(), shapes.hulls(fragment).size(), fragment);
    compound_ = makeCompound(fragments_.size());
    const btTransform objectToBody = bodyFrame.inverse();
    for (const uint32_t fragment : fragments) {
        const btTransform place = objectToBody * shapes.bodyFrame(fragment);
        for (const auto& hull : shapes.hulls(fragment)) compound_->addChildShape(place, hull.get());
    }
}

btCollisionShape* FragmentShapes::shape(uint32_t fragment) const {
    return shapes_[fragment];
}

btTransform FragmentShapes::bodyFrame(uint32_t fragment) const {
    const Fragment& piece = asset_->fragment(fragment);
    return btTransform(toBullet(piece.inertiaOrientation).normalized(),
                       toBullet(piece.centerOfMass));
}

}  // namespace sherd
