// SPDX-License-Identifier: MIT
// P. J. Schneider, "An Algorithm for Automatically Fitting Digitized Curves", Graphics Gems, 1990:
// least squares for the lengths of the two tangents, parameters improved by Newton steps, split at
// the worst point if that is not enough.
#include "map/bitmap_curves.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

namespace sherd {

namespace {

constexpr int kNewtonRounds = 4;
constexpr size_t kTangentPoints = 5;

using Bezier = std::array<glm::dvec2, 4>;

std::array<double, 4> bernstein(double t) {
    const double s = 1 - t;
    return {s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t};
}

glm::dvec2 at(const Bezier& c, double t) {
    const std::array<double, 4> b = bernstein(t);
    return b[0] * c[0] + b[1] * c[1] + b[2] * c[2] + b[3] * c[3];
}

glm::dvec2 unitOr(glm::dvec2 v, glm::dvec2 otherwise) {
    const double length = glm::length(v);
    return length > 0 ? v / length : otherwise;
}

struct Section {
    std::span<const glm::dvec2> points;
    glm::dvec2 start, end;  ///< unit tangents, both into the section
};

std::vector<double> chordParameters(std::span<const glm::dvec2> points) {
    std::vector<double> t(points.size(), 0);
    for (size_t i = 1; i < points.size(); ++i)
        t[i] = t[i - 1] + glm::distance(points[i - 1], points[i]);
    const double length = t.back();
    for (size_t i = 0; i < t.size(); ++i)
        t[i] = length > 0 ? t[i] / length : static_cast<double>(i) / (t.size() - 1.0);
    return t;
}

Bezier leastSquares(const Section& section, const std::vector<double>& t) {
    const glm::dvec2 first = section.points.front();
    const glm::dvec2 last = section.points.back();
    double c00 = 0;
    double c01 = 0;
    double c11 = 0;
    double x0 = 0;
    double x1 = 0;
    for (size_t i = 0; i < t.size(); ++i) {
        const std::array<double, 4> b = bernstein(t[i]);
        const glm::dvec2 a0 = b[1] * section.start;
        const glm::dvec2 a1 = b[2] * section.end;
        const glm::dvec2 rest = section.points[i] - (b[0] + b[1]) * first - (b[2] + b[3]) * last;
        c00 += glm::dot(a0, a0);
        c01 += glm::dot(a0, a1);
        c11 += glm::dot(a1, a1);
        x0 += glm::dot(a0, rest);
        x1 += glm::dot(a1, rest);
    }
    const double determinant = c00 * c11 - c01 * c01;
    const double chord = glm::distance(first, last);
    double alpha0 = 0;
    double alpha1 = 0;
    if (std::abs(determinant) > 1e-12 * c00 * c11) {
        alpha0 = (x0 * c11 - x1 * c01) / determinant;
        alpha1 = (c00 * x1 - c01 * x0) / determinant;
    }
    // Tangents that point backwards or far away make loops: a third of the chord, as Schneider.
    const double most = 2 * chord;
    if (!(alpha0 > 1e-6 * chord && alpha1 > 1e-6 * chord && alpha0 < most && alpha1 < most))
        alpha0 = alpha1 = chord / 3;
    return {first, first + alpha0 * section.start, last + alpha1 * section.end, last};
}

/// One Newton step of each parameter towards the curve's point nearest to its own.
void improve(const Bezier& c, std::span<const glm::dvec2> points, std::vector<double>& t) {
    for (size_t i = 0; i < t.size(); ++i) {
        const double s = 1 - t[i];
        const glm::dvec2 d1 = 3.0 * (s * s * (c[1] - c[0]) + 2 * s * t[i] * (c[2] - c[1]) +
                                     t[i] * t[i] * (c[3] - c[2]));
        const glm::dvec2 d2 =
            6.0 * (s * (c[2] - 2.0 * c[1] + c[0]) + t[i] * (c[3] - 2.0 * c[2] + c[1]));
        const glm::dvec2 away = at(c, t[i]) - points[i];
        const double slope = glm::dot(d1, d1) + glm::dot(away, d2);
        if (slope > 0) t[i] = std::clamp(t[i] - glm::dot(away, d1) / slope, 0.0, 1.0);
    }
}

struct Worst {
    size_t at = 0;
    double distance = 0;
};

Worst worst(const Bezier& c, std::span<const glm::dvec2> points, const std::vector<double>& t) {
    Worst result{points.size() / 2, 0};
    for (size_t i = 1; i + 1 < points.size(); ++i) {
        const double distance = glm::distance(at(c, t[i]), points[i]);
        if (distance > result.distance) result = {i, distance};
    }
    return result;
}

struct Fit {
    Bezier curve;
    Worst worst;
};

Fit fit(const Section& section, double tolerance) {
    std::vector<double> t = chordParameters(section.points);
    Fit best{leastSquares(section, t), {}};
    best.worst = worst(best.curve, section.points, t);
    Fit next = best;
    for (int round = 0; round < kNewtonRounds && next.worst.distance > tolerance; ++round) {
        improve(next.curve, section.points, t);
        next.curve = leastSquares(section, t);
        next.worst = worst(next.curve, section.points, t);
        if (next.worst.distance < best.worst.distance) best = next;
    }
    return best;
}

/// From the first point towards the next few.
glm::dvec2 startTangent(std::span<const glm::dvec2> points) {
    const size_t reach = std::min(kTangentPoints, points.size() - 1);
    return unitOr(points[reach] - points[0], {1, 0});
}

glm::dvec2 tangentAt(std::span<const glm::dvec2> points, size_t i) {
    const size_t reach = std::min({kTangentPoints, i, points.size() - 1 - i});
    return unitOr(points[i + reach] - points[i - reach], {1, 0});
}

}  // namespace

void fitCurves(std::span<const glm::dvec2> points, double tolerance, Outline& outline) {
    if (points.size() < 2) return;
    const std::vector<glm::dvec2> backwards(points.rbegin(), points.rend());
    Section whole{points, startTangent(points), startTangent(backwards)};
    if (points.size() > 4 && points.front() == points.back()) {
        whole.start = unitOr(points[1] - points[points.size() - 2], whole.start);
        whole.end = -whole.start;
    }
    std::vector<Section> open{whole};
    while (!open.empty()) {
        const Section section = open.back();
        open.pop_back();
        if (section.points.size() == 2) {
            outline.pieces.push_back(linePiece(section.points.back()));
            continue;
        }
        const Fit found = fit(section, tolerance);
        if (found.worst.distance <= tolerance) {
            outline.pieces.push_back(
                cubicPiece(found.curve[1], found.curve[2], section.points.back()));
            continue;
        }
        const size_t split = found.worst.at;
        const glm::dvec2 tangent = tangentAt(section.points, split);
        open.push_back({section.points.subspan(split), tangent, section.end});
        open.push_back({section.points.first(split + 1), section.start, -tangent});
    }
}

}  // namespace sherd
