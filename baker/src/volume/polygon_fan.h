// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "volume/cap_space.h"

namespace sherd {

/// Triangles of a small convex polygon: the best shaped corner is cut off first.
class PolygonFan {
  public:
    /// Good until the next call.
    std::span<const std::array<uint32_t, 3>> run(std::span<const uint32_t> corners,
                                                 const CapSpace& vertices);

  private:
    std::vector<uint32_t> left_;
    std::vector<std::array<uint32_t, 3>> triangles_;
};

}  // namespace sherd
