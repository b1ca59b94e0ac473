// SPDX-License-Identifier: MIT
// Points with exact rational coordinates and their orientation: a double filter first, then 256
// bits.
#pragma once

#include <cstdint>

namespace sherd {

/// (x / w, y / w), w > 0. |x|, |y| below 2^90, w below 2^59, so that the orientation of three such
/// points takes at most 2 * 90 + 59 + 3 = 242 bits.
struct ExactPoint {
    __int128 x = 0;
    __int128 y = 0;
    int64_t w = 1;
    /// Bit mask of lines this point is known to lie on: three points that share a bit are
    /// collinear, without any arithmetic. Points on the border of a triangle are the common case.
    uint32_t lines = 0;
    double ax = 0, ay = 0;  ///< x / w and y / w within 3 * 2^-53 relative; see `setApproximation`

    void setApproximation() {
        ax = static_cast<double>(x) / static_cast<double>(w);
        ay = static_cast<double>(y) / static_cast<double>(w);
    }
};

/// 1 if a, b, c turn left (x right, y up), -1 right, 0 collinear. Exact. `extent` bounds |ax|,
/// |ay|.
int orientation(const ExactPoint& a, const ExactPoint& b, const ExactPoint& c, double extent);

}  // namespace sherd
