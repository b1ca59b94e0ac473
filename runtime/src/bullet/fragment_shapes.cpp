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

}  // namespace

FragmentShapes::FragmentShapes(std::shared_ptr<const Asset> asset) : asset_(std::move(asset)) {
    const FractureSet& set = asset_->set();
    shapes_.reserve(set.fragments.size());
    for (uint32_t f = 0; f < asset_->fragmentCount(); ++f) {
        const Range range = set.fragments[f].hulls;
        const btTransform objectToBody = bodyFrame(f).inverse();
        for (uint32_t h = range.first; h < range.first + range.count; ++h) {
            hulls_.push_back(makeHull(set, set.hulls[h], objectToBody));
        }
        if (range.count == 1) {
            shapes_.push_back(hulls_.back().get());
            continue;
        }
        constexpr uint32_t kTreeWorthwhile =
            8;  // below, testing every child is cheaper than a tree
        auto compound =
            std::make_unique<btCompoundShape>(range.count > kTreeWorthwhile, int(range.count));
        compound->setMargin(0);  // the children have their own
        for (uint32_t h = 0; h < range.count; ++h) {
            compound->addChildShape(btTransform::getIdentity(),
                                    hulls_[hulls_.size() - range.count + h].get());
        }
        shapes_.push_back(compound.get());
        compounds_.push_back(std::move(compound));
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
