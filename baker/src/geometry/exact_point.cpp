// SPDX-License-Identifier: MIT
#include "geometry/exact_point.h"

#include <boost/multiprecision/cpp_int.hpp>

namespace sherd {
namespace {

int exactOrientation(const ExactPoint& a, const ExactPoint& b, const ExactPoint& c) {
    using Wide = boost::multiprecision::int256_t;
    const Wide ax(a.x), ay(a.y), bx(b.x), by(b.y), cx(c.x), cy(c.y);
    const Wide det =
        ax * (by * c.w - cy * b.w) - ay * (bx * c.w - cx * b.w) + (bx * cy - cx * by) * a.w;
    return det.sign();
}

}  // namespace

int orientation(const ExactPoint& a, const ExactPoint& b, const ExactPoint& c, double extent) {
    if ((a.lines & b.lines & c.lines) != 0) return 0;
    const double det = (b.ax - a.ax) * (c.ay - a.ay) - (b.ay - a.ay) * (c.ax - a.ax);
    // With |coordinates| <= M and each off by 3 * 2^-53 M: differences are off by 9e-16 M, the two
    // products by 4e-15 M^2 each; 1e-14 M^2 covers it.
    const double bound = 1e-14 * extent * extent;
    if (det > bound) return 1;
    if (det < -bound) return -1;
    return exactOrientation(a, b, c);
}

}  // namespace sherd
