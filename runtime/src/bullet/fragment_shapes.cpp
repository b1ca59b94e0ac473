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

/// From so many colliders on, arranging them takes long enough to do it beforehand.
constexpr size_t kLargeFamily = 64;

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
    families_.resize(asset_->fragmentCount());
    for (uint32_t f = 0; f < asset_->fragmentCount(); ++f) makeFamily(f);
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
    compounds_[fragment] = std::make_unique<ColliderSet>(range.count);
    for (const auto& hull : hulls(fragment))
        compounds_[fragment]->addChildShape(btTransform::getIdentity(), hull.get());
    shapes_[fragment] = compounds_[fragment].get();
}

void FragmentShapes::makeFamily(uint32_t fragment) {
    const Range children = asset_->fragment(fragment).children;
    size_t count = 0;
    for (uint32_t c = 0; c < children.count; ++c) count += hulls(children.first + c).size();
    if (count < kLargeFamily) return;
    Family& family = families_[fragment];
    family.colliders = std::make_unique<ColliderSet>(count);
    family.fragments.reserve(count);
    for (uint32_t c = children.first; c < children.first + children.count; ++c)
        for (const auto& hull : hulls(c)) {
            family.colliders->addChildShape(bodyFrame(c), hull.get());
            family.fragments.push_back(c);
        }
}

const FragmentShapes::Family* FragmentShapes::familyOf(std::span<const uint32_t> fragments) const {
    // What most of them are children of, if anything is: the middle one is.
    const int32_t parent = asset_->fragment(fragments[fragments.size() / 2]).parent;
    if (parent < 0 || !families_[size_t(parent)].colliders) return nullptr;
    const Range children = asset_->fragment(uint32_t(parent)).children;
    const auto first = std::lower_bound(fragments.begin(), fragments.end(), children.first);
    const auto end = std::lower_bound(first, fragments.end(), children.first + children.count);
    return size_t(end - first) * 2 > children.count ? &families_[size_t(parent)] : nullptr;
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
