// SPDX-License-Identifier: MIT
// Points and planes in homogeneous integers.
#pragma once

#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <glm/vec3.hpp>

#include "volume/cut_grid.h"

namespace sherd {

/// (x, y, z) / w in grid steps, w > 0. Below 2^165 and 2^138: the determinant of three such points
/// and a projection takes less than 480 bits.
struct ExactPlace {
    using Integer = boost::multiprecision::int512_t;
    Integer x, y, z, w;
};
bool operator==(const ExactPlace& a, const ExactPlace& b);

/// n . p + c with n and c in homogeneous integers.
struct ExactPlane {
    std::array<ExactPlace::Integer, 4> of;
};

/// Through three points of the grid: normal below 2^54, offset 2^81.
ExactPlane planeThrough(const CutGridPoint& a, const CutGridPoint& b, const CutGridPoint& c);

/// w = 0 if they have no one point in common.
ExactPlace meet(const ExactPlane& a, const ExactPlane& b, const ExactPlane& c);

/// In doubles, each coordinate within a few units in its last place.
glm::dvec3 rounded(const ExactPlace& p);

}  // namespace sherd
