// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace sherd {

class FragmentShapes;

/// Which fragments of an object, of whatever levels, have colliders inside each other as they lie
/// in it. What comes apart lies so at first: known beforehand, a break tests no shapes.
class RestOverlaps {
  public:
    /// `tolerance`: share of the object's diagonal that colliders may be inside each other and only
    /// touch.
    RestOverlaps(const FragmentShapes& shapes, float tolerance);

    [[nodiscard]] float tolerance() const { return tolerance_; }

    [[nodiscard]] bool areNone() const { return others_.empty(); }
    /// Ascending; a fragment does not overlap its own parts.
    [[nodiscard]] std::span<const uint32_t> of(uint32_t fragment) const {
        return std::span(others_).subspan(first_[fragment],
                                          first_[fragment + 1] - first_[fragment]);
    }

  private:
    float tolerance_;
    std::vector<uint32_t> first_;
    std::vector<uint32_t> others_;
};

}  // namespace sherd
