// SPDX-License-Identifier: MIT
// NURBS to lines.
//
//   1. knots -> spans      the whole knot vector, and its spans of positive length
//   2. span -> Bezier      exact: the control points of a span are its blossom at the span's ends
//                          (Ramshaw 1989, "Blossoms are polar forms"; the same as inserting both
//                          knots to full multiplicity, Piegl and Tiller 1997, 5.3)
//   3. Bezier -> line      halved until every control point is near the chord (Farin 1993, "Curves
//                          and Surfaces for CAGD", rational de Casteljau)
//
// With positive weights a rational Bezier curve lies in the convex hull of its control points, and
// the distance from a segment is a convex function: what bounds the control points bounds the
// curve. Points are kept beside their weights, not multiplied by them, so that every step is a
// convex combination of points: nothing overflows, and ends are met exactly, whatever the weights.
#include "map/nurbs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

namespace sherd {

namespace {

/// Weights may differ by more than doubles can tell apart once averaged; below this share of the
/// largest, a weight's exact size shows nowhere but at its own end point.
constexpr double kLeastWeight = 1e-100;
/// Halvings of the parameter before a curve counts as too large for its tolerance: enough for
/// weights as different as kLeastWeight lets them be, at every degree.
constexpr size_t kMaxDepth = 1200;
/// A curve that gets as far as this is not flattened on: maps end at 8, and it would cost millions
/// of points to say so later.
constexpr double kFarOut = 1000;
/// Left for the rounding of points and distances.
constexpr double kToleranceShare = 0.999;

struct Weighted {
    glm::dvec2 point{0.0};
    double weight = 1;
};

/// (1 - t) a + t b in homogeneous coordinates; exact at t = 0 and 1.
Weighted blend(const Weighted& a, const Weighted& b, double t) {
    const double weight = (1 - t) * a.weight + t * b.weight;
    const double share = t * b.weight / weight;
    return {(1 - share) * a.point + share * b.point, weight};
}

/// In place, not on the heap: there may be millions of them.
struct Bezier {
    std::array<Weighted, kMaxNurbsDegree + 1> points;
    size_t count = 0;

    const Weighted& front() const { return points[0]; }
    const Weighted& back() const { return points[count - 1]; }
};

/// The curve's control points and knots as those of an open one: closed curves repeat the first
/// `degree` points, and their knots go on periodically at both ends.
struct OpenCurve {
    size_t degree;
    std::vector<Weighted> points;
    std::vector<double> knots;
};

std::vector<double> openKnots(const NurbsCurve& curve) {
    const size_t p = curve.degree;
    const size_t n = curve.points.size();
    std::vector<double> knots = curve.knots;
    if (!curve.closed) {
        for (size_t i = 0; curve.knots.empty() && i < n + p + 1; ++i)
            knots.push_back(static_cast<double>(std::clamp(i, p, n) - p));
        return knots;
    }
    for (size_t i = 0; curve.knots.empty() && i <= n; ++i) knots.push_back(static_cast<double>(i));
    const double period = knots.back() - knots.front();
    std::vector<double> all;
    for (size_t k = p; k > 0; --k) all.push_back(knots[n - k] - period);
    all.insert(all.end(), knots.begin(), knots.end());
    for (size_t k = 1; k <= p; ++k) all.push_back(knots[k] + period);
    return all;
}

OpenCurve openCurve(const NurbsCurve& curve) {
    OpenCurve open{curve.degree, {}, openKnots(curve)};
    const double largest =
        curve.weights.empty() ? 1 : *std::max_element(curve.weights.begin(), curve.weights.end());
    const size_t n = curve.points.size();
    for (size_t i = 0; i < n + (curve.closed ? curve.degree : 0); ++i) {
        const double weight = curve.weights.empty() ? 1 : curve.weights[i % n] / largest;
        open.points.push_back({curve.points[i % n], std::max(weight, kLeastWeight)});
    }
    return open;
}

/// The Bezier points of the span from knot `span` to the next one.
Bezier bezierOf(const OpenCurve& curve, size_t span) {
    const size_t p = curve.degree;
    const std::vector<double>& u = curve.knots;
    const double low = u[span];
    const double high = u[span + 1];
    Bezier bezier;
    for (size_t k = 0; k <= p; ++k) {
        // The blossom at `low` p - k times and `high` k times, by de Boor's recurrence.
        std::array<Weighted, kMaxNurbsDegree + 1> d;
        std::copy_n(&curve.points[span - p], p + 1, d.begin());
        for (size_t r = 1; r <= p; ++r) {
            const double at = r <= p - k ? low : high;
            for (size_t j = p; j >= r; --j) {
                const double left = u[span - p + j];
                const double right = u[span + 1 + j - r];
                d[j] = blend(d[j - 1], d[j], (at - left) / (right - left));
            }
        }
        bezier.points[bezier.count++] = d[p];
    }
    return bezier;
}

double distanceToSegment(glm::dvec2 p, glm::dvec2 a, glm::dvec2 b) {
    const glm::dvec2 along = b - a;
    const double size = glm::dot(along, along);
    const double t = size > 0 ? std::clamp(glm::dot(p - a, along) / size, 0.0, 1.0) : 0.0;
    return glm::length(p - (a + t * along));
}

bool isFlat(const Bezier& bezier, double tolerance) {
    for (size_t i = 1; i + 1 < bezier.count; ++i)
        if (!(distanceToSegment(bezier.points[i].point, bezier.front().point,
                                bezier.back().point) <= tolerance))
            return false;
    return true;
}

/// Halves at the middle of the parameter: `bezier` becomes the second half, the first is returned.
Bezier halve(Bezier& bezier) {
    Bezier first;
    for (size_t left = bezier.count; left > 0; --left) {
        first.points[first.count++] = bezier.front();
        for (size_t i = 0; i + 1 < left; ++i)
            bezier.points[i] = blend(bezier.points[i], bezier.points[i + 1], 0.5);
    }
    return first;
}

/// Appends the points after the first.
bool flattenBezier(const Bezier& bezier, double tolerance, size_t limit,
                   std::vector<glm::dvec2>& out) {
    struct Piece {
        Bezier bezier;
        size_t depth;
    };
    std::vector<Piece> open{{bezier, 0}};
    while (!open.empty()) {
        Piece piece = open.back();
        open.pop_back();
        if (isFlat(piece.bezier, tolerance)) {
            const glm::dvec2 end = piece.bezier.back().point;
            const bool near = std::abs(end.x) <= kFarOut && std::abs(end.y) <= kFarOut;
            if (!near || out.size() >= limit) return false;
            // Where weights differ wildly, whole stretches of the parameter stay in one point.
            if (piece.bezier.back().point != out.back()) out.push_back(piece.bezier.back().point);
            continue;
        }
        if (piece.depth >= kMaxDepth) return false;
        const Bezier first = halve(piece.bezier);
        open.push_back({piece.bezier, piece.depth + 1});
        open.push_back({first, piece.depth + 1});
    }
    return true;
}

std::optional<NurbsProblem> checkWeights(const NurbsCurve& curve) {
    if (curve.weights.empty()) return std::nullopt;
    if (curve.weights.size() != curve.points.size())
        return NurbsProblem{"weights", "as many weights as points were expected, " +
                                           std::to_string(curve.points.size())};
    for (size_t i = 0; i < curve.weights.size(); ++i)
        if (!(curve.weights[i] > 0) || !std::isfinite(curve.weights[i]))
            return NurbsProblem{"weights/" + std::to_string(i), "a weight above 0 was expected"};
    return std::nullopt;
}

/// No knot may be repeated so often that the curve falls apart; in the whole knot vector.
std::optional<NurbsProblem> checkMultiplicity(const NurbsCurve& curve) {
    const size_t p = curve.degree;
    const std::vector<double> knots = openKnots(curve);
    const size_t last = knots.size() - 1 - p;  // the curve runs from knot p to this one
    for (size_t i = 0; i < knots.size();) {
        size_t end = i;
        while (end < knots.size() && knots[end] == knots[i]) ++end;
        const bool inside = curve.closed || (knots[i] > knots[p] && knots[i] < knots[last]);
        if (end - i > (inside ? p : p + 1)) {
            const size_t at = !curve.closed ? i : std::min(i < p ? 0 : i - p, curve.points.size());
            return NurbsProblem{"knots/" + std::to_string(at),
                                "a knot is repeated " + std::to_string(end - i) +
                                    " times; at degree " + std::to_string(p) + " it may be " +
                                    std::to_string(inside ? p : p + 1) + " times here"};
        }
        i = end;
    }
    return std::nullopt;
}

std::optional<NurbsProblem> checkKnots(const NurbsCurve& curve) {
    const std::vector<double>& knots = curve.knots;
    if (knots.empty()) return std::nullopt;
    const size_t n = curve.points.size();
    const size_t wanted = curve.closed ? n + 1 : n + curve.degree + 1;
    if (knots.size() != wanted)
        return NurbsProblem{
            "knots", std::to_string(wanted) + " knots were expected, " +
                         (curve.closed ? "points + 1 of a closed curve" : "points + degree + 1")};
    for (size_t i = 0; i < knots.size(); ++i)
        if (!std::isfinite(knots[i]) || (i > 0 && knots[i] < knots[i - 1]))
            return NurbsProblem{"knots/" + std::to_string(i),
                                "a knot not below the one before it was expected"};
    const double from = curve.closed ? knots.front() : knots[curve.degree];
    const double to = curve.closed ? knots.back() : knots[n];
    if (!(from < to)) return NurbsProblem{"knots", "the knots leave the curve no length"};
    // Periodic ones are moved by a period to either side.
    if (!std::isfinite(4 * knots.front()) || !std::isfinite(4 * knots.back()))
        return NurbsProblem{"knots", "the knots are too large for a number"};
    return checkMultiplicity(curve);
}

}  // namespace

std::optional<NurbsProblem> checkNurbs(const NurbsCurve& curve) {
    if (curve.points.size() <= curve.degree)
        return NurbsProblem{"points", "a curve of degree " + std::to_string(curve.degree) +
                                          " needs at least " + std::to_string(curve.degree + 1) +
                                          " points"};
    if (std::optional<NurbsProblem> problem = checkWeights(curve)) return problem;
    return checkKnots(curve);
}

std::optional<std::vector<glm::dvec2>> flattenNurbs(const NurbsCurve& curve, double tolerance,
                                                    size_t limit) {
    const OpenCurve open = openCurve(curve);
    const size_t p = curve.degree;
    std::vector<glm::dvec2> points;
    for (size_t span = p; span < open.points.size(); ++span) {
        if (!(open.knots[span] < open.knots[span + 1])) continue;
        const Bezier bezier = bezierOf(open, span);
        if (points.empty()) points.push_back(bezier.front().point);
        if (!flattenBezier(bezier, tolerance * kToleranceShare, limit, points)) return std::nullopt;
    }
    if (points.size() == 1) points.push_back(points.front());
    if (curve.closed) points.back() = points.front();
    return points;
}

}  // namespace sherd
