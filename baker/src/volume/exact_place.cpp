// SPDX-License-Identifier: MIT
#include "volume/exact_place.h"

#include "geometry/exact_grid.h"

namespace sherd {
namespace {

using Integer = ExactPlace::Integer;

Integer minor(const ExactPlane& a, const ExactPlane& b, const ExactPlane& c, size_t i, size_t j,
              size_t k) {
    return a.of[i] * (b.of[j] * c.of[k] - b.of[k] * c.of[j]) +
           a.of[j] * (b.of[k] * c.of[i] - b.of[i] * c.of[k]) +
           a.of[k] * (b.of[i] * c.of[j] - b.of[j] * c.of[i]);
}

}  // namespace

bool operator==(const ExactPlace& a, const ExactPlace& b) {
    return a.x * b.w == b.x * a.w && a.y * b.w == b.y * a.w && a.z * b.w == b.z * a.w;
}

ExactPlane planeThrough(const CutGridPoint& a, const CutGridPoint& b, const CutGridPoint& c) {
    const int64_t ux = int64_t{b.x} - a.x, uy = int64_t{b.y} - a.y, uz = int64_t{b.z} - a.z;
    const int64_t vx = int64_t{c.x} - a.x, vy = int64_t{c.y} - a.y, vz = int64_t{c.z} - a.z;
    const int64_t nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
    const Int128 offset = -(Int128{nx} * a.x + Int128{ny} * a.y + Int128{nz} * a.z);
    return {{Integer(nx), Integer(ny), Integer(nz), Integer(offset)}};
}

ExactPlace meet(const ExactPlane& a, const ExactPlane& b, const ExactPlane& c) {
    ExactPlace p{-minor(a, b, c, 3, 1, 2), -minor(a, b, c, 0, 3, 2), -minor(a, b, c, 0, 1, 3),
                 minor(a, b, c, 0, 1, 2)};
    if (p.w < 0) p = {-p.x, -p.y, -p.z, -p.w};
    return p;
}

glm::dvec3 rounded(const ExactPlace& p) {
    // A quotient of numbers of up to 165 bits, each first rounded to a double's 53.
    const auto w = p.w.convert_to<double>();
    return {p.x.convert_to<double>() / w, p.y.convert_to<double>() / w,
            p.z.convert_to<double>() / w};
}

}  // namespace sherd
