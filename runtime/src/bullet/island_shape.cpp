// SPDX-License-Identifier: MIT
#include "bullet/island_shape.h"

#include <algorithm>

namespace sherd {
namespace {

/// With fewer colliders, those of a changed body are made anew: what little that saves is not worth
/// a second compound around them in every contact.
constexpr size_t kManyColliders = 64;

size_t countColliders(const FragmentShapes& shapes, std::span<const uint32_t> fragments) {
    size_t count = 0;
    for (const uint32_t fragment : fragments) count += shapes.hulls(fragment).size();
    return count;
}

}  // namespace

void IslandShape::clear() {
    outer_.reset();
    colliders_.reset();
    fragments_.clear();
}

void IslandShape::build(const FragmentShapes& shapes, std::span<const uint32_t> fragments,
                        const btTransform& bodyFrame, Marks& marks) {
    clear();
    const btTransform objectToBody = bodyFrame.inverse();
    const size_t count = countColliders(shapes, fragments);
    if (count < kManyColliders) {
        colliders_ = std::make_unique<ColliderSet>(count);
        fragments_.reserve(count);
        for (const uint32_t fragment : fragments) {
            const btTransform place = objectToBody * shapes.bodyFrame(fragment);
            for (const auto& hull : shapes.hulls(fragment)) {
                colliders_->addChildShape(place, hull.get());
                fragments_.push_back(fragment);
            }
        }
        return;
    }
    const FragmentShapes::Family* family = shapes.familyOf(fragments);
    if (family) {
        colliders_ = std::make_unique<ColliderSet>(*family->colliders);
        fragments_.assign(family->fragments.begin(), family->fragments.end());
    } else {
        colliders_ = std::make_unique<ColliderSet>(count);
    }
    // With a tree, though it holds only one: two compounds meet by their trees.
    outer_ = std::make_unique<ColliderSet>(1, true);
    outer_->addChildShape(objectToBody, colliders_.get());
    exchange(shapes, fragments, marks);
    settle(bodyFrame);
}

bool IslandShape::become(const FragmentShapes& shapes, std::span<const uint32_t> fragments,
                         const btTransform& bodyFrame, Marks& marks) {
    const size_t count = countColliders(shapes, fragments);
    if (!outer_ || count < kManyColliders || count < fragments_.size() / 2) return false;
    exchange(shapes, fragments, marks);
    settle(bodyFrame);
    return true;
}

/// Marks are 1 for what is wanted, 2 for what is there as well.
void IslandShape::exchange(const FragmentShapes& shapes, std::span<const uint32_t> fragments,
                           Marks& marks) {
    if (marks.size() < shapes.asset()->fragmentCount())
        marks.resize(shapes.asset()->fragmentCount());
    for (const uint32_t fragment : fragments) marks[fragment] = 1;
    for (size_t i = 0; i < fragments_.size();) {
        uint8_t& mark = marks[fragments_[i]];
        if (mark != 0) {
            mark = 2;
            ++i;
            continue;
        }
        colliders_->removeChildShapeByIndex(int(i));
        fragments_[i] = fragments_.back();
        fragments_.pop_back();
    }
    for (const uint32_t fragment : fragments) {
        if (marks[fragment] == 1)
            for (const auto& hull : shapes.hulls(fragment)) {
                colliders_->addChildShape(shapes.bodyFrame(fragment), hull.get());
                fragments_.push_back(fragment);
            }
        marks[fragment] = 0;
    }
}

void IslandShape::settle(const btTransform& bodyFrame) {
    colliders_->recalculateLocalAabb();
    outer_->updateChildTransform(0, bodyFrame.inverse(), true);
}

}  // namespace sherd
