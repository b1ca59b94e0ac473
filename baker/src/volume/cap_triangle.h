// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>

namespace sherd {

/// Of the cap between two cells. Where the winding number is 2, a cap has two layers of the same
/// triangles, and so on; each layer is a surface of its own.
struct CapTriangle {
    std::array<uint32_t, 3> v;
    int32_t layer;  ///< from 1, reversed ones from -1; 0: flat triangles that sew borders up
};

}  // namespace sherd
