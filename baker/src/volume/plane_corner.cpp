// SPDX-License-Identifier: MIT
#include "volume/plane_corner.h"

#include <boost/multiprecision/cpp_int.hpp>

#include "geometry/perturbed_signs.h"

namespace sherd {
namespace {

using Wide = boost::multiprecision::int256_t;

/// Of the slopes: at most 6 * 2^87.
Int128 determinant(const LinearFunction& a, const LinearFunction& b, const LinearFunction& c) {
    return Int128{a.x} * (Int128{b.y} * c.z - Int128{b.z} * c.y) +
           Int128{a.y} * (Int128{b.z} * c.x - Int128{b.x} * c.z) +
           Int128{a.z} * (Int128{b.x} * c.y - Int128{b.y} * c.x);
}

}  // namespace

int signAtPlaneCorner(const std::array<const BoundingPlane*, 3>& corner, const BoundingPlane& l,
                      uint32_t i) {
    const LinearFunction& a = corner[0]->function;
    const LinearFunction& b = corner[1]->function;
    const LinearFunction& c = corner[2]->function;
    // The 4 x 4 determinant of all four over the 3 x 3 of the corner's slopes is l's value there:
    // expanded along the offsets, which are what is perturbed.
    const std::array<const BoundingPlane*, 4> plane{corner[0], corner[1], corner[2], &l};
    const std::array<Int128, 4> minor{-determinant(b, c, l.function), determinant(a, c, l.function),
                                      -determinant(a, b, l.function), determinant(a, b, c)};
    const int side = signOf(minor[3]);
    Wide exact = 0;  // at most 24 * 2^(87 + 57)
    for (size_t k = 0; k < 4; ++k) exact += Wide(minor[k]) * Wide(plane[k]->function.c);
    if (exact.sign() != 0) return side * exact.sign();
    Nudge best{0, 0};
    Int128 own = 0;
    for (size_t k = 0; k < 4; ++k) {
        if (plane[k]->isBox()) continue;
        keepHighest(best, {plane[k]->index, signOf(minor[k])});
        own -= minor[k];
    }
    keepHighest(best, {i, signOf(own)});
    return side * best.sign;
}

glm::dvec3 planeCorner(const std::array<const BoundingPlane*, 3>& corner) {
    const LinearFunction& a = corner[0]->function;
    const LinearFunction& b = corner[1]->function;
    const LinearFunction& c = corner[2]->function;
    const auto whole = static_cast<double>(determinant(a, b, c));
    // Cramer's rule: at most 6 * 2^(29 + 29 + 57) in size.
    const auto with = [&](int64_t LinearFunction::*column) {
        LinearFunction p = a, q = b, r = c;
        p.*column = a.c;
        q.*column = b.c;
        r.*column = c.c;
        return -static_cast<double>(determinant(p, q, r)) / whole;
    };
    return {with(&LinearFunction::x), with(&LinearFunction::y), with(&LinearFunction::z)};
}

}  // namespace sherd
