// SPDX-License-Identifier: MIT
// Exact points and lines of the UV plane for checks, sharing no code with the baker: homogeneous
// integers in units of 2^-24, reduced, so that equal points have equal numbers.
//
// With UV in [-4, 4] a grid coordinate takes 26 bits and a sign, a line's (a, b, c) 27, 27 and 54,
// the crossing of two lines (x, y, w) 82, 82 and 55, a line's value there 111: __int128 holds all
// but the comparison of two crossings, which takes 256 bits.
#pragma once

#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <tuple>
#include <utility>

namespace sherd::test::exact {

using Int = __int128;
using Wide = boost::multiprecision::int256_t;

struct Grid {
    int64_t x = 0, y = 0;
    friend bool operator==(const Grid& a, const Grid& b) { return a.x == b.x && a.y == b.y; }
    friend bool operator<(const Grid& a, const Grid& b) {
        return a.x != b.x ? a.x < b.x : a.y < b.y;
    }
};

inline Grid snap(double u, double v) {
    return {std::llround(u * 16777216.0), std::llround(v * 16777216.0)};
}

inline Int gcd(Int a, Int b) {
    if (a < 0) a = -a;
    if (b < 0) b = -b;
    while (b != 0) {
        // Once both fit, 64-bit division is much faster.
        if (a <= INT64_MAX && b <= INT64_MAX)
            return std::gcd(static_cast<int64_t>(a), static_cast<int64_t>(b));
        a %= b;
        std::swap(a, b);
    }
    return a;
}

/// (x / w, y / w), w > 0, without a common factor.
struct Point {
    Int x = 0, y = 0, w = 1;

    Point() = default;
    Point(Grid p) : x(p.x), y(p.y) {}
    Point(Int px, Int py, Int pw) : x(px), y(py), w(pw) {
        if (w < 0) {
            x = -x;
            y = -y;
            w = -w;
        }
        const Int divisor = gcd(gcd(x, y), w);
        x /= divisor;
        y /= divisor;
        w /= divisor;
    }
    double u() const { return static_cast<double>(x) / static_cast<double>(w); }
    double v() const { return static_cast<double>(y) / static_cast<double>(w); }
    friend bool operator==(const Point& p, const Point& q) {
        return p.x == q.x && p.y == q.y && p.w == q.w;
    }
    /// Any total order will do.
    friend bool operator<(const Point& p, const Point& q) {
        return std::tie(p.x, p.y, p.w) < std::tie(q.x, q.y, q.w);
    }
};

inline int sign(Int x) {
    return (x > 0) - (x < 0);
}

/// a x + b y + c = 0 through two grid points; positive to the left of p -> q.
struct Line {
    Int a = 0, b = 0, c = 0;

    Line() = default;
    Line(Grid p, Grid q) : a(p.y - q.y), b(q.x - p.x), c(Int{p.x} * q.y - Int{p.y} * q.x) {}
    Int at(const Point& p) const { return a * p.x + b * p.y + c * p.w; }
    /// The same endless line, whatever two points it was made from.
    Line reduced() const {
        Int divisor = gcd(gcd(a, b), c);
        if (a < 0 || (a == 0 && b < 0)) divisor = -divisor;
        Line line;
        line.a = a / divisor;
        line.b = b / divisor;
        line.c = c / divisor;
        return line;
    }
    friend bool operator==(const Line& l, const Line& m) {
        return l.a == m.a && l.b == m.b && l.c == m.c;
    }
};

inline bool parallel(const Line& l, const Line& m) {
    return l.a * m.b == l.b * m.a;
}

/// Of lines that are not parallel.
inline Point crossing(const Line& l, const Line& m) {
    return {l.b * m.c - l.c * m.b, l.c * m.a - l.a * m.c, l.a * m.b - l.b * m.a};
}

/// -1, 0, 1: how far p lies along the direction (dx, dy) compared with q.
inline int compareAlong(const Point& p, const Point& q, int64_t dx, int64_t dy) {
    const Wide left = (Wide(p.x) * dx + Wide(p.y) * dy) * Wide(q.w);
    const Wide right = (Wide(q.x) * dx + Wide(q.y) * dy) * Wide(p.w);
    return left < right ? -1 : (right < left ? 1 : 0);
}

/// 1 if p, q, r turn left, -1 right, 0 if they lie on one line.
inline int turn(const Point& p, const Point& q, const Point& r) {
    const Wide px(p.x), py(p.y), pw(p.w), qx(q.x), qy(q.y), qw(q.w), rx(r.x), ry(r.y), rw(r.w);
    const Wide det = px * (qy * rw - ry * qw) - py * (qx * rw - rx * qw) + (qx * ry - rx * qy) * pw;
    return det.sign();
}

/// num / den, den > 0, reduced. Compares where both take at most 60 bits.
struct Fraction {
    Int num = 0, den = 1;

    Fraction() = default;
    Fraction(Int n, Int d) : num(n), den(d) {
        Int divisor = gcd(num, den);
        if (den < 0) divisor = -divisor;
        num /= divisor;
        den /= divisor;
    }
    double value() const { return static_cast<double>(num) / static_cast<double>(den); }
    friend bool operator==(const Fraction& s, const Fraction& t) {
        return s.num == t.num && s.den == t.den;
    }
    friend bool operator<(const Fraction& s, const Fraction& t) {
        return s.num * t.den < t.num * s.den;
    }
};

/// The parameter of p along a -> b, on which it lies.
inline Fraction parameter(Grid a, Grid b, const Point& p) {
    if (a.x != b.x) return {p.x - a.x * p.w, (Int{b.x} - a.x) * p.w};
    return {p.y - a.y * p.w, (Int{b.y} - a.y) * p.w};
}

inline Point pointAt(Grid a, Grid b, const Fraction& t) {
    return {a.x * t.den + t.num * (b.x - a.x), a.y * t.den + t.num * (b.y - a.y), t.den};
}

}  // namespace sherd::test::exact
