// SPDX-License-Identifier: MIT
// Exact predicates over points of an integer grid and over the crossings of lines through them.
//
// A crossing is never rounded: it is the pair of lines that make it, or a line and the parameter
// along it as a fraction. With coordinates of at most 27 bits and a sign,
//   a difference takes 28 bits and a sign,
//   a cross product of two differences 57 bits and a sign (2 * 2^28 * 2^28 = 2^57): int64_t,
//   a parameter along a line two such numbers,
//   comparing two parameters 114 bits, the side of a crossing 115 bits: Int128.
// The orientation of three crossings would take 189 bits or more: it is not offered here.
#pragma once

#include <cassert>
#include <cmath>
#include <compare>
#include <cstdint>
#include <optional>

namespace sherd {

using Int128 = __int128;

/// A point of the grid; one unit is 2^-24. |coordinate| <= kGridLimit.
struct GridPoint {
    int32_t u = 0;
    int32_t v = 0;
    friend bool operator==(const GridPoint&, const GridPoint&) = default;
    // NOLINTNEXTLINE(modernize-use-nullptr): clang-tidy 14 misreads a defaulted <=>
    friend auto operator<=>(const GridPoint&, const GridPoint&) = default;
};
inline constexpr int32_t kGridOne = 1 << 24;         ///< 1.0 on the grid
inline constexpr int32_t kGridLimit = 8 * kGridOne;  ///< 2^27: the widths above hold up to here

/// The nearest integer, halves away from zero. (std::llround is a call, and three times as slow.)
inline int32_t roundToInteger(double x) {
    const auto whole = static_cast<int32_t>(x);
    const double rest = x - whole;
    return whole + (rest >= 0.5 ? 1 : 0) - (rest <= -0.5 ? 1 : 0);
}

/// The nearest grid point (halves away from zero). Nothing for NaN, infinities and anything beyond
/// the limit.
inline std::optional<GridPoint> snapToGrid(double u, double v) {
    const double limit = static_cast<double>(kGridLimit) / kGridOne;
    if (!(std::abs(u) <= limit) || !(std::abs(v) <= limit)) return std::nullopt;
    return GridPoint{roundToInteger(u * kGridOne), roundToInteger(v * kGridOne)};
}

/// -1, 0 or 1.
constexpr int signOf(int64_t x) {
    return (x > 0) - (x < 0);
}
constexpr int signOf(Int128 x) {
    return (x > 0) - (x < 0);
}

/// (b - a) x (d - c), at most 2^57 in size.
constexpr int64_t crossOf(GridPoint a, GridPoint b, GridPoint c, GridPoint d) {
    return (int64_t{b.u} - a.u) * (int64_t{d.v} - c.v) -
           (int64_t{b.v} - a.v) * (int64_t{d.u} - c.u);
}

/// Twice the signed area of the triangle p, q, r, at most 2^57 in size: positive if r is to the
/// left of p -> q where u points right and v up.
constexpr int64_t orientation(GridPoint p, GridPoint q, GridPoint r) {
    return crossOf(p, q, p, r);
}

/// A position along a line a -> b: a + (num / den) (b - a). den > 0; both at most 2^57 in size.
/// Not reduced: compare with `<=>` and `==` only, which are exact (products of 114 bits).
struct LineParameter {
    int64_t num = 0;
    int64_t den = 1;

    friend std::strong_ordering operator<=>(const LineParameter& x, const LineParameter& y) {
        return Int128{x.num} * y.den <=> Int128{y.num} * x.den;
    }
    friend bool operator==(const LineParameter& x, const LineParameter& y) {
        return std::is_eq(x <=> y);
    }
    /// Within 3 * 2^-53 of its size.
    double approximate() const { return static_cast<double>(num) / static_cast<double>(den); }
    bool insideClosed() const { return num >= 0 && num <= den; }  ///< on the segment a..b
    bool insideOpen() const { return num > 0 && num < den; }      ///< strictly between a and b
};

/// Where the line through c, d crosses the line a -> b, both taken as endless. Nothing if they are
/// parallel or the same.
inline std::optional<LineParameter> crossingParameter(GridPoint a, GridPoint b, GridPoint c,
                                                      GridPoint d) {
    int64_t den = crossOf(a, b, c, d);
    if (den == 0) return std::nullopt;
    int64_t num = crossOf(a, c, c, d);
    if (den < 0) {
        den = -den;
        num = -num;
    }
    return LineParameter{num, den};
}

/// The parameter of a grid point that lies on the line a -> b (a != b).
inline LineParameter gridParameter(GridPoint a, GridPoint b, GridPoint p) {
    assert(a != b && orientation(a, b, p) == 0);
    int64_t den = int64_t{b.u} - a.u;
    int64_t num = int64_t{p.u} - a.u;
    if (den == 0) {
        den = int64_t{b.v} - a.v;
        num = int64_t{p.v} - a.v;
    }
    return den < 0 ? LineParameter{-num, -den} : LineParameter{num, den};
}

/// The side of the point at `t` along a -> b, seen from p -> q: 1 left, 0 on the line, -1 right.
/// With t the crossing of a -> b and another line this is the side of that crossing. 115 bits.
inline int sideOfPoint(GridPoint p, GridPoint q, GridPoint a, GridPoint b, LineParameter t) {
    return signOf(Int128{orientation(p, q, a)} * t.den + Int128{t.num} * crossOf(p, q, a, b));
}

/// The side of the crossing of the lines a -> b and c -> d, which are not parallel.
inline int sideOfCrossing(GridPoint p, GridPoint q, GridPoint a, GridPoint b, GridPoint c,
                          GridPoint d) {
    const std::optional<LineParameter> t = crossingParameter(a, b, c, d);
    assert(t);
    return sideOfPoint(p, q, a, b, *t);
}

/// The grid point at `t` along a..b, if there is one exactly there. t is in [0, 1]. 86 bits.
inline std::optional<GridPoint> gridPointAt(GridPoint a, GridPoint b, LineParameter t) {
    assert(t.insideClosed());
    const Int128 du = Int128{t.num} * (int64_t{b.u} - a.u);
    const Int128 dv = Int128{t.num} * (int64_t{b.v} - a.v);
    if (du % t.den != 0 || dv % t.den != 0) return std::nullopt;
    return GridPoint{static_cast<int32_t>(a.u + static_cast<int64_t>(du / t.den)),
                     static_cast<int32_t>(a.v + static_cast<int64_t>(dv / t.den))};
}

}  // namespace sherd
