// SPDX-License-Identifier: MIT
#include "map/nurbs.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "map/svg_curves.h"
#include "support/property.h"

using namespace sherd;
using namespace sherd::test;

namespace {

using Points = std::vector<glm::dvec2>;
constexpr size_t kMany = 1'000'000;

Points flat(const NurbsCurve& curve, double tolerance = 1e-4) {
    const auto problem = checkNurbs(curve);
    if (problem) FAIL(problem->member << ": " << problem->message);
    const auto points = flattenNurbs(curve, tolerance, kMany);
    REQUIRE(points);
    return *points;
}

double distanceTo(const Points& line, glm::dvec2 p) {
    double nearest = INFINITY;
    for (size_t k = 1; k < line.size(); ++k) {
        const glm::dvec2 d = line[k] - line[k - 1];
        const double size = glm::dot(d, d);
        const double t = size > 0 ? std::clamp(glm::dot(p - line[k - 1], d) / size, 0.0, 1.0) : 0.0;
        nearest = std::min(nearest, glm::length(line[k - 1] + t * d - p));
    }
    return nearest;
}

/// The basis function by its definition (Cox and de Boor): slow, and nothing like the code.
double basis(const std::vector<double>& knots, size_t i, size_t p, double u) {
    if (p == 0) return knots[i] <= u && u < knots[i + 1] ? 1 : 0;
    double value = 0;
    if (knots[i + p] > knots[i])
        value += (u - knots[i]) / (knots[i + p] - knots[i]) * basis(knots, i, p - 1, u);
    if (knots[i + p + 1] > knots[i + 1])
        value += (knots[i + p + 1] - u) / (knots[i + p + 1] - knots[i + 1]) *
                 basis(knots, i + 1, p - 1, u);
    return value;
}

glm::dvec2 pointAt(const NurbsCurve& curve, double u) {
    glm::dvec2 sum(0);
    double weights = 0;
    for (size_t i = 0; i < curve.points.size(); ++i) {
        const double w =
            basis(curve.knots, i, curve.degree, u) * (curve.weights.empty() ? 1 : curve.weights[i]);
        sum += w * curve.points[i];
        weights += w;
    }
    return sum / weights;
}

/// A circle about (0.5, 0.5) of radius 0.25 as four rational quadratic arcs.
NurbsCurve circle() {
    const double w = std::sqrt(0.5);
    NurbsCurve curve;
    curve.degree = 2;
    for (const auto& [x, y] : std::initializer_list<std::pair<double, double>>{
             {1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}, {1, 0}})
        curve.points.push_back(glm::dvec2(0.5) + 0.25 * glm::dvec2(x, y));
    curve.weights = {1, w, 1, w, 1, w, 1, w, 1};
    curve.knots = {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4};
    return curve;
}

NurbsCurve randomCurve(Random& random) {
    NurbsCurve curve;
    curve.degree = 1 + random.below(4);
    const size_t n = curve.degree + 1 + random.below(6);
    for (size_t i = 0; i < n; ++i) {
        curve.points.emplace_back(random.in(-1, 1), random.in(-1, 1));
        curve.weights.push_back(std::pow(10, random.in(-2, 2)));
    }
    double at = 0;
    size_t repeats = 0;
    for (size_t i = 0; i < n + curve.degree + 1; ++i) {
        const bool again = random.below(3) == 0 && repeats + 1 < curve.degree && i != n;
        repeats = again ? repeats + 1 : 0;
        if (!again) at += random.in(0.1, 2);
        curve.knots.push_back(at);
    }
    return curve;
}

}  // namespace

TEST_CASE("a curve of equal points is a line of two") {
    NurbsCurve curve;
    curve.points.assign(5, glm::dvec2(0.3, 0.4));
    CHECK(flat(curve) == Points(2, glm::dvec2(0.3, 0.4)));
    curve.closed = true;
    CHECK(flat(curve) == Points(2, glm::dvec2(0.3, 0.4)));
}

TEST_CASE("degree 1 is the polyline, open or closed, whatever its weights and knots") {
    NurbsCurve curve;
    curve.degree = 1;
    curve.points = {{0.1, 0.7}, {0.3, 0.2}, {0.9, 0.9}, {0.4, 0.3}};
    CHECK(flat(curve) == curve.points);
    curve.weights = {1, 7, 1e-9, 3};
    curve.knots = {0, 0, 1, 5, 6, 6};
    CHECK(flat(curve) == curve.points);
    curve.closed = true;
    curve.knots.clear();
    Points ring = curve.points;
    ring.push_back(ring.front());
    CHECK(flat(curve) == ring);
}

TEST_CASE("a circle of rational quadratics stays within the tolerance of the true circle") {
    for (const double tolerance : {1e-2, 1e-4, 1e-6}) {
        const Points points = flat(circle(), tolerance);
        CHECK(points.front() == glm::dvec2(0.75, 0.5));
        CHECK(points.back() == points.front());
        double worst = 0;
        for (size_t k = 1; k < points.size(); ++k)
            for (int s = 0; s <= 8; ++s) {
                const glm::dvec2 p = glm::mix(points[k - 1], points[k], s / 8.0);
                worst = std::max(worst, std::abs(glm::length(p - glm::dvec2(0.5)) - 0.25));
            }
        CHECK(worst <= tolerance);
        for (int i = 0; i < 1000; ++i) {
            const double angle = i * 0.0062831853;
            const glm::dvec2 on = 0.5 + 0.25 * glm::dvec2(std::cos(angle), std::sin(angle));
            CHECK(distanceTo(points, on) <= tolerance);
        }
        // Within a factor of the fewest chords a circle needs.
        const double fewest = 3.1415927 / std::acos(1 - tolerance / 0.25);
        CHECK(static_cast<double>(points.size()) < 4 * fewest + 8);
    }
}

TEST_CASE("a cubic whose knots have full multiplicity is the Bezier curve") {
    NurbsCurve curve;
    curve.points = {{0, 0}, {0, 1}, {1, 1}, {1, 0}, {1, -1}, {0.5, -1}, {0.2, 0.3}};
    curve.knots = {0, 0, 0, 0, 1, 1, 1, 2, 2, 2, 2};
    Outline outline{curve.points[0], {}, false};
    for (size_t i = 1; i < 7; i += 3)
        outline.pieces.push_back(
            cubicPiece(curve.points[i], curve.points[i + 1], curve.points[i + 2]));
    const Points bezier = *flatten(outline, {}, 1e-5, kMany);
    const Points points = flat(curve, 1e-5);
    for (const glm::dvec2 p : points) CHECK(distanceTo(bezier, p) <= 2e-5);
    for (const glm::dvec2 p : bezier) CHECK(distanceTo(points, p) <= 2e-5);
    CHECK(std::find(points.begin(), points.end(), curve.points[3]) != points.end());
}

TEST_CASE("a clamped curve meets its end points exactly") {
    for (size_t degree = 1; degree <= kMaxNurbsDegree; ++degree) {
        NurbsCurve curve;
        curve.degree = degree;
        for (size_t i = 0; i <= degree + 3; ++i) {
            curve.points.emplace_back(0.1 + 0.3 * static_cast<double>(i % 3),
                                      1.0 / (1.0 + static_cast<double>(i)));
            curve.weights.push_back(0.1 + static_cast<double>(i) / 7);
        }
        const Points points = flat(curve);
        CHECK(points.front() == curve.points.front());
        CHECK(points.back() == curve.points.back());
    }
}

TEST_CASE("a closed curve of default knots is the uniform periodic spline") {
    // A square's quadratic periodic spline touches the middles of its sides.
    NurbsCurve curve;
    curve.degree = 2;
    curve.closed = true;
    curve.points = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    const Points points = flat(curve, 1e-5);
    CHECK(points.front() == points.back());
    for (const glm::dvec2 middle : {glm::dvec2(0.5, 0), {1, 0.5}, {0.5, 1}, {0, 0.5}})
        CHECK(distanceTo(points, middle) <= 1e-5);
    for (const glm::dvec2 p : points) CHECK(glm::length(p - glm::dvec2(0.5)) >= 0.4999);
    NurbsCurve stated = curve;
    stated.knots = {3, 5, 7, 9, 11};
    CHECK(flat(stated, 1e-5) == points);
}

TEST_CASE("wild weights neither hang nor leave the hull, and the ends hold") {
    for (const double wild : {1e-300, 1e-12, 1e12, 1e300})
        for (size_t at = 0; at < 4; ++at)
            for (const size_t degree : {1, 2, 3}) {
                NurbsCurve curve;
                curve.degree = degree;
                curve.points = {{0, 0}, {0, 1}, {1, 1}, {1, 0}};
                curve.weights = {1, 1, 1, 1};
                curve.weights[at] = wild;
                const Points points = flat(curve, 1e-6);
                CHECK(points.front() == curve.points.front());
                CHECK(points.back() == curve.points.back());
                CHECK(points.size() < 3000);
                for (const glm::dvec2 p : points) {
                    CHECK(std::clamp(p.x, 0.0, 1.0) == p.x);
                    CHECK(std::clamp(p.y, 0.0, 1.0) == p.y);
                }
            }
    NurbsCurve pulled;
    pulled.degree = 2;
    pulled.points = {{0, 0}, {0.5, 1}, {1, 0}};
    pulled.weights = {1, 1e300, 1};
    CHECK(distanceTo(flat(pulled), {0.5, 1}) <= 1e-4);
}

TEST_CASE("knots as close as numbers come, and as far, are no trouble") {
    NurbsCurve curve;
    curve.degree = 2;
    curve.points = {{0, 0}, {0, 1}, {1, 1}, {1, 0}};
    for (const double knot : {5e-324, 1e-300, 1e300}) {
        curve.knots = {0, 0, 0, knot, 4e307, 4e307, 4e307};
        const Points points = flat(curve);
        CHECK(points.back() == curve.points.back());
        for (const glm::dvec2 p : points) CHECK(std::isfinite(p.x + p.y));
    }
}

TEST_CASE("curves too large for their tolerance end at the limit") {
    NurbsCurve curve;
    curve.points = {{0, 0}, {0, 1e5}, {1e5, 0}, {3, 3}};
    CHECK_FALSE(flattenNurbs(curve, 1e-8, 1000));
    for (const double huge : {1e17, 1e160, 1.7e308}) {
        curve.points[1].y = curve.points[2].x = huge;
        CHECK_FALSE(flattenNurbs(curve, 1e-4, 100'000));
    }
    // Once took a minute under the sanitizers, to be refused in the end.
    Random random(1);
    curve = {};
    curve.degree = 10;
    for (int i = 0; i < 300; ++i) curve.points.emplace_back(random.in(0, 1e9), random.in(0, 1e9));
    CHECK_FALSE(flattenNurbs(curve, 1e-4, 4'000'000));
}

TEST_CASE("random curves: the line and the curve are within the tolerance of each other") {
    const int cases = propertyCases(150);
    for (int seed = 1; seed <= cases; ++seed) {
        CAPTURE(seed);
        Random random(static_cast<uint32_t>(seed));
        const NurbsCurve curve = randomCurve(random);
        const double tolerance = 1e-3;
        const Points points = flat(curve, tolerance);
        const double from = curve.knots[curve.degree];
        const double to = curve.knots[curve.points.size()];
        Points on;
        for (int i = 0; i < 2000; ++i)
            on.push_back(pointAt(curve, from + (to - from) * i / 2000.0));
        on.push_back(pointAt(curve, to - (to - from) * 1e-12));
        double worst = 0;
        for (const glm::dvec2 p : on) worst = std::max(worst, distanceTo(points, p));
        CHECK(worst <= tolerance);
        CHECK(glm::length(points.front() - on.front()) < 1e-9);
        CHECK(glm::length(points.back() - on.back()) < 1e-6);
        // The other way round, against the sampled curve, whose samples stray a little themselves.
        double gap = 0;
        for (size_t k = 1; k < on.size(); ++k) gap = std::max(gap, glm::length(on[k] - on[k - 1]));
        for (size_t k = 1; k < points.size(); ++k)
            worst = std::max(worst, distanceTo(on, 0.5 * (points[k - 1] + points[k])) - gap);
        CHECK(worst <= tolerance);
    }
}

TEST_CASE("random closed curves: smooth over their start, wherever they start") {
    const int cases = propertyCases(50);
    for (int seed = 1; seed <= cases; ++seed) {
        CAPTURE(seed);
        Random random(static_cast<uint32_t>(seed));
        NurbsCurve curve;
        curve.closed = true;
        curve.degree = 1 + random.below(4);
        const size_t n = curve.degree + 1 + random.below(5);
        double at = 0;
        for (size_t i = 0; i < n; ++i) {
            curve.points.emplace_back(random.in(-1, 1), random.in(-1, 1));
            curve.knots.push_back(at);
            at += random.in(0.5, 2);
        }
        curve.knots.push_back(at);
        NurbsCurve turned = curve;
        std::rotate(turned.points.begin(), turned.points.begin() + 1, turned.points.end());
        turned.knots.assign(curve.knots.begin() + 1, curve.knots.end());
        turned.knots.push_back(at + curve.knots[1] - curve.knots[0]);
        const Points a = flat(curve, 1e-4);
        const Points b = flat(turned, 1e-4);
        CHECK(a.front() == a.back());
        for (const glm::dvec2 p : a) CHECK(distanceTo(b, p) <= 2e-4);
        for (const glm::dvec2 p : b) CHECK(distanceTo(a, p) <= 2e-4);
    }
}
