// SPDX-License-Identifier: MIT
// The arrangement of segments by brute force over rational numbers without limit: all pairs, points
// compared by value. Shares nothing with `planarise` but its input.
#pragma once

#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace sherd::test {

/// A fraction that is never reduced: the sums here stay short, and gcds would cost more.
struct Rational {
    using Integer = boost::multiprecision::cpp_int;
    Integer num = 0;
    Integer den = 1;  ///< positive

    Rational() = default;
    Rational(int64_t whole) : num(whole) {}
    Rational(Integer n, Integer d) : num(std::move(n)), den(std::move(d)) {
        if (den >= 0) return;
        num = -num;
        den = -den;
    }
    friend Rational operator+(const Rational& a, const Rational& b) {
        return {a.num * b.den + b.num * a.den, a.den * b.den};
    }
    friend Rational operator*(const Rational& a, const Rational& b) {
        return {a.num * b.num, a.den * b.den};
    }
    friend bool operator==(const Rational& a, const Rational& b) {
        return a.num * b.den == b.num * a.den;
    }
    friend bool operator<(const Rational& a, const Rational& b) {
        return a.num * b.den < b.num * a.den;
    }
    friend bool operator<=(const Rational& a, const Rational& b) { return !(b < a); }
};
using RationalPoint = std::pair<Rational, Rational>;

struct OracleSegment {
    std::array<int64_t, 4> ends{};  ///< u0, v0, u1, v1
    uint32_t level = 1;
};

struct OracleArrangement {
    std::vector<RationalPoint> points;  ///< sorted
    std::map<std::pair<RationalPoint, RationalPoint>, uint32_t>
        edges;  ///< lower point first; level
};

/// How many connected parts the edges form.
template <class Edges>
size_t componentsOf(size_t nodes, const Edges& edges) {
    std::vector<size_t> label(nodes);
    for (size_t i = 0; i < nodes; ++i) label[i] = i;
    for (bool changed = true; changed;) {
        changed = false;
        for (const auto& [a, b] : edges) {
            const size_t low = std::min(label[a], label[b]);
            changed = changed || label[a] != low || label[b] != low;
            label[a] = label[b] = low;
        }
    }
    return std::set<size_t>(label.begin(), label.end()).size();
}

/// The points two segments have in common that split either: their crossing, or the ends of an
/// overlap.
inline std::vector<RationalPoint> sharedPoints(const OracleSegment& s, const OracleSegment& t) {
    const auto [x1, y1, x2, y2] = s.ends;
    const auto [x3, y3, x4, y4] = t.ends;
    // s: n . p = k, with n its normal. Likewise t. Cramer's rule.
    const int64_t n1 = y2 - y1;
    const int64_t m1 = x1 - x2;
    const int64_t n2 = y4 - y3;
    const int64_t m2 = x3 - x4;
    using Integer = Rational::Integer;
    const Integer k1 = Integer(n1) * x1 + Integer(m1) * y1;
    const Integer k2 = Integer(n2) * x3 + Integer(m2) * y3;
    const Integer determinant = Integer(n1) * m2 - Integer(n2) * m1;
    const auto within = [](const OracleSegment& segment, const RationalPoint& p) {
        const auto [a, b, c, d] = segment.ends;
        return Rational(std::min(a, c)) <= p.first && p.first <= Rational(std::max(a, c)) &&
               Rational(std::min(b, d)) <= p.second && p.second <= Rational(std::max(b, d));
    };
    if (determinant != 0) {
        const RationalPoint p{Rational(k1 * m2 - k2 * m1, determinant),
                              Rational(k2 * n1 - k1 * n2, determinant)};
        if (within(s, p) && within(t, p)) return {p};
        return {};
    }
    if (Integer(n1) * x3 + Integer(m1) * y3 != k1) return {};
    std::vector<RationalPoint> points;
    for (const RationalPoint& p : {RationalPoint{x1, y1}, RationalPoint{x2, y2},
                                   RationalPoint{x3, y3}, RationalPoint{x4, y4}})
        if (within(s, p) && within(t, p)) points.push_back(p);
    return points;
}

inline OracleArrangement arrange(const std::vector<OracleSegment>& segments) {
    OracleArrangement out;
    std::set<RationalPoint> all;
    for (const OracleSegment& s : segments) {
        const auto [x1, y1, x2, y2] = s.ends;
        if (x1 == x2 && y1 == y2) continue;
        std::set<RationalPoint> own{{x1, y1}, {x2, y2}};
        for (const OracleSegment& t : segments)
            if (t.ends[0] != t.ends[2] || t.ends[1] != t.ends[3])
                for (const RationalPoint& p : sharedPoints(s, t)) own.insert(p);
        all.insert(own.begin(), own.end());
        for (auto p = own.begin(); std::next(p) != own.end(); ++p) {
            const auto [at, fresh] = out.edges.try_emplace({*p, *std::next(p)}, s.level);
            if (!fresh) at->second = std::min(at->second, s.level);
        }
    }
    out.points.assign(all.begin(), all.end());
    return out;
}

}  // namespace sherd::test
