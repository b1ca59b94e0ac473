// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <span>

#include "bullet/fragment_shapes.h"
#include "sherd/runtime/memory.h"

namespace sherd {

/// Several fragments as one body: all their colliders, side by side. Few of them lie in the body's
/// own frame. Many lie in the object's, in a compound within the body's compound: when a part comes
/// off and the centre of mass moves, only the place of the inner one changes.
class IslandShape {
  public:
    /// Per fragment, zero between calls.
    using Marks = Vector<uint8_t>;

    /// Makes it anew of these, ascending. Keeps its memory.
    void build(const FragmentShapes& shapes, std::span<const uint32_t> fragments,
               const btTransform& bodyFrame, Marks& marks);
    /// Lets go of what it consists of.
    void clear();

    /// Makes it consist of these, ascending, by taking out and adding what differs. The shape stays
    /// the same, so that a body in the world need not leave it; Bullet sees by the revision that it
    /// has changed. False, and nothing done, when there is less to do in making a new one.
    bool become(const FragmentShapes& shapes, std::span<const uint32_t> fragments,
                const btTransform& bodyFrame, Marks& marks);

    [[nodiscard]] btCollisionShape* shape() const {
        return outer_ ? outer_.get() : colliders_.get();
    }
    /// In the order of the colliders; one that has several is listed for each.
    [[nodiscard]] std::span<const uint32_t> fragments() const { return fragments_; }
    /// The fragment that a collider belongs to, by the index Bullet gives with a contact or a ray.
    [[nodiscard]] uint32_t fragmentOf(int child) const { return fragments_[size_t(child)]; }

  private:
    void exchange(const FragmentShapes& shapes, std::span<const uint32_t> fragments, Marks& marks);
    void settle(const btTransform& bodyFrame);

    std::unique_ptr<ColliderSet> colliders_;
    std::unique_ptr<ColliderSet> outer_;  ///< null: the colliders lie in the body's frame
    Vector<uint32_t> fragments_;          ///< per collider
};

}  // namespace sherd
