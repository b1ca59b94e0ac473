// SPDX-License-Identifier: MIT
#include "bullet/fragment_shapes.h"

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

FragmentShapes::FragmentShapes(std::shared_ptr<const Asset> asset) : asset_(std::move(asset)) {
    const FractureSet& set = asset_->set();
    shapes_.reserve(set.fragments.size());
    firstHull_.reserve(set.fragments.size());
    for (uint32_t f = 0; f < asset_->fragmentCount(); ++f) {
        const Range range = set.fragments[f].hulls;
        const btTransform objectToBody = bodyFrame(f).inverse();
        firstHull_.push_back(uint32_t(hulls_.size()));
        for (uint32_t h = range.first; h < range.first + range.count; ++h) {
            hulls_.push_back(makeHull(set, set.hulls[h], objectToBody));
        }
        if (range.count == 1) {
            shapes_.push_back(hulls_.back().get());
            continue;
        }
        compounds_.push_back(makeCompound(range.count));
        for (const auto& hull : hulls(f))
            compounds_.back()->addChildShape(btTransform::getIdentity(), hull.get());
        shapes_.push_back(compounds_.back().get());
    }
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
