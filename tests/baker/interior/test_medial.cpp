// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>

#include "geometry/bounds.h"
#include "geometry/inside_test.h"
#include "geometry/triangle.h"
#include "geometry/triangle_bvh.h"
#include "interior/medial.h"
#include "interior/shapes.h"
#include "support/property.h"

using namespace sherd;
using namespace sherd::test;

namespace {

/// The medial surface, with the promise checked that nothing is outside.
MedialSurface medialOf(const SurfaceMesh& mesh, const MedialOptions& options = {}) {
    const MeshTopology topology = buildTopology(mesh.positions, mesh.triangles);
    const Result<MedialSurface> result = medialSurface(mesh, topology, options);
    REQUIRE(result.has_value());
    REQUIRE(result->points.size() >= mesh.positions.size());
    if (mesh.triangles.empty()) return *result;
    const InsideTest inside(mesh.positions, mesh.triangles);
    const TriangleBvh bvh(mesh.positions, mesh.triangles);
    const double skin = 1e-6 * boundsOf(mesh.positions, mesh.triangles).diagonal();
    std::vector<uint8_t> used(result->points.size(), 0);
    for (const auto& t : result->triangles.triangles)
        for (const uint32_t v : t.v) used[v] = 1;
    uint32_t outside = 0;
    for (size_t v = 0; v < used.size(); ++v) {
        const glm::dvec3 p(result->points[v]);
        if (used[v] == 0 || inside.inside(p)) continue;
        if (bvh.closest(p, std::max(skin, 1e-30)).triangle == ClosestPoint::kNone) ++outside;
    }
    CHECK(outside == 0);
    return *result;
}

MedialSurface medialOf(const Shape& shape, const MedialOptions& options = {}) {
    return medialOf(shape.mesh(), options);
}

std::vector<std::array<uint32_t, 3>> trianglesOf(const MedialSurface& medial) {
    std::vector<std::array<uint32_t, 3>> triangles;
    for (const auto& t : medial.triangles.triangles) triangles.push_back(t.v);
    return triangles;
}

double volumeOf(const std::vector<glm::vec3>& points,
                const std::vector<std::array<uint32_t, 3>>& triangles) {
    double six = 0;
    for (const auto& [a, b, c] : triangles) {
        six += glm::dot(glm::dvec3(points[a]),
                        glm::cross(glm::dvec3(points[b]), glm::dvec3(points[c])));
    }
    return six / 6;
}

double diagonalOf(const Shape& shape) {
    return boundsOf(shape.positions, shape.triangles).diagonal();
}

/// A point of the surface, its outward normal and M of it.
struct Sample {
    glm::dvec3 point, normal, inner;
};

std::vector<Sample> samplesOf(const Shape& shape, const MedialSurface& medial, int count) {
    Random random(7);
    std::vector<double> sums;
    double area = 0;
    for (const auto& t : shape.triangles) sums.push_back(area += triangleArea(shape.positions, t));
    std::vector<Sample> samples;
    for (int i = 0; i < count; ++i) {
        const auto it = std::upper_bound(sums.begin(), sums.end(), random.unit() * area);
        const auto t = static_cast<uint32_t>(std::min<std::ptrdiff_t>(
            it - sums.begin(), static_cast<std::ptrdiff_t>(sums.size()) - 1));
        double u = random.unit(), v = random.unit();
        if (u + v > 1) {
            u = 1 - u;
            v = 1 - v;
        }
        const auto& [a, b, c] = shape.triangles[t];
        const glm::dvec3 pa(shape.positions[a]), pb(shape.positions[b]), pc(shape.positions[c]);
        samples.push_back({pa * (1 - u - v) + pb * u + pc * v,
                           glm::normalize(glm::cross(pb - pa, pc - pa)),
                           medial.at(t, {1 - u - v, u, v})});
    }
    return samples;
}

/// The largest distance of M from where geometry says it is, in diagonals.
double farthest(const Shape& shape, const MedialSurface& medial,
                const std::function<glm::dvec3(const Sample&)>& expected) {
    double worst = 0;
    for (const Sample& s : samplesOf(shape, medial, 4000))
        worst = std::max(worst, glm::distance(s.inner, expected(s)));
    return worst / diagonalOf(shape);
}

/// Of the object's volume, what its pieces together have too little or too much.
double volumeLost(const Shape& shape, const MedialSurface& medial) {
    return volumeOf(medial.points, trianglesOf(medial)) /
           volumeOf(shape.positions, shape.triangles);
}

/// Below a point of a box's face: half way through, or as far as the nearest side.
glm::dvec3 belowFace(const Sample& s, const glm::dvec3& low, const glm::dvec3& high) {
    double radius = INFINITY;
    for (int k = 0; k < 3; ++k) {
        const bool across = std::abs(s.normal[k]) > 0.5;
        const double width = high[k] - low[k];
        radius = std::min(radius,
                          across ? width / 2 : std::min(s.point[k] - low[k], high[k] - s.point[k]));
    }
    return s.point - radius * s.normal;
}

/// A solid of revolution: profile points (distance from the axis, height), once around, with the
/// solid on the left.
Shape lathe(const std::vector<glm::dvec2>& profile, uint32_t around) {
    Shape shape;
    const auto count = static_cast<uint32_t>(profile.size());
    for (uint32_t i = 0; i < around; ++i) {
        const double angle = 2 * std::numbers::pi * i / around;
        for (const glm::dvec2& p : profile)
            shape.positions.emplace_back(p.x * std::cos(angle), p.x * std::sin(angle), p.y);
        for (uint32_t j = 0; j < count; ++j) {
            const uint32_t i2 = (i + 1) % around, j2 = (j + 1) % count;
            const uint32_t a = i * count + j, b = i2 * count + j, c = i2 * count + j2,
                           d = i * count + j2;
            shape.triangles.push_back({a, b, c});
            shape.triangles.push_back({a, c, d});
        }
    }
    return shape;
}

/// The medial axis of a polygon, solid on the left, in many points: from places along each side,
/// and around each corner that points inwards, the largest circle that reaches over the outline
/// nowhere, found by halving.
std::vector<glm::dvec2> medialAxisOf(const std::vector<glm::dvec2>& outline) {
    constexpr int kPlaces = 400;
    const size_t count = outline.size();
    const auto inwards = [&](size_t i) {
        const glm::dvec2 along = glm::normalize(outline[(i + 1) % count] - outline[i]);
        return glm::dvec2(-along.y, along.x);
    };
    const auto clearance = [&](const glm::dvec2& c) {
        double least = INFINITY;
        for (size_t i = 0; i < count; ++i) {
            const glm::dvec2 a = outline[i], ab = outline[(i + 1) % count] - a;
            const double t = std::clamp(glm::dot(c - a, ab) / glm::dot(ab, ab), 0.0, 1.0);
            least = std::min(least, glm::distance(c, a + t * ab));
        }
        return least;
    };
    std::vector<glm::dvec2> axis;
    const auto add = [&](const glm::dvec2& p, const glm::dvec2& direction) {
        double fits = 0, tooLarge = 10;
        for (int i = 0; i < 50; ++i) {
            const double radius = (fits + tooLarge) / 2;
            (clearance(p + radius * direction) >= radius * 0.9999 ? fits : tooLarge) = radius;
        }
        axis.push_back(p + fits * direction);
    };
    for (size_t i = 0; i < count; ++i) {
        const glm::dvec2 a = outline[i], ab = outline[(i + 1) % count] - a;
        for (int k = 0; k <= kPlaces; ++k)
            add(a + ab * (k / static_cast<double>(kPlaces)), inwards(i));
        const glm::dvec2 before = inwards((i + count - 1) % count), after = inwards(i);
        if (before.x * after.y - before.y * after.x >= 0) continue;
        for (int k = 1; k < kPlaces; ++k)
            add(a, glm::normalize(glm::mix(before, after, k / static_cast<double>(kPlaces))));
    }
    return axis;
}

}  // namespace

TEST_CASE("an empty mesh has an empty medial surface") {
    CHECK(medialOf(SurfaceMesh{}).points.empty());
    SurfaceMesh cloud;
    cloud.positions = {{0, 0, 0}, {1, 2, 3}};
    const MedialSurface medial = medialOf(cloud);
    CHECK(medial.points == cloud.positions);
    CHECK(medial.onSurface == 2);
}

TEST_CASE("settings out of range are refused with the range") {
    const SurfaceMesh mesh = box({0, 0, 0}, {1, 1, 1}).mesh();
    const MeshTopology topology = buildTopology(mesh.positions, mesh.triangles);
    const auto refused = [&](const MedialOptions& options, const std::string& range) {
        const Result<MedialSurface> result = medialSurface(mesh, topology, options);
        REQUIRE_FALSE(result.has_value());
        CHECK(result.error().code == ErrorCode::badArgument);
        CHECK(result.error().message.find(range) != std::string::npos);
    };
    MedialOptions options;
    options.preSmoothing = -1;
    refused(options, "0 to 1000");
    options = {};
    options.separationAngle = 181;
    refused(options, "0 to 180");
    options = {};
    options.scaleAxis = 0.5;
    refused(options, "1 to 10");
    options = {};
    options.smallestRadius = std::nan("");
    refused(options, "0 to 1");
}

TEST_CASE("surfaces in one plane or one point stay where they are") {
    SurfaceMesh flat;
    flat.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 2, 0}, {0, 2, 0}};
    flat.triangles = {{0, 1, 2}, {0, 2, 3}, {2, 4, 5}};
    const MedialSurface medial = medialOf(flat);
    for (size_t v = 0; v < flat.positions.size(); ++v)
        CHECK(glm::distance(medial.points[v], flat.positions[v]) < 1e-6F);

    SurfaceMesh twoSided = flat;
    twoSided.triangles = {{0, 1, 2}, {0, 2, 1}};
    const MedialSurface folded = medialOf(twoSided);
    for (size_t v = 0; v < flat.positions.size(); ++v)
        CHECK(glm::distance(folded.points[v], flat.positions[v]) < 1e-6F);

    SurfaceMesh point;
    point.positions = {{3, 3, 3}};
    point.triangles = {{0, 0, 0}};
    CHECK(medialOf(point).points == point.positions);
}

TEST_CASE("a box of 12 triangles has the ridges of its six roofs, at any size") {
    for (const float size : {1.0F, 1e6F, 1e-6F}) {
        const glm::vec3 high = size * glm::vec3(1, 2, 3);
        const Shape shape = box(glm::vec3(0), high);
        const MedialSurface medial = medialOf(shape);
        CHECK(farthest(shape, medial, [&](const Sample& s) {
                  return belowFace(s, glm::dvec3(0), glm::dvec3(high));
              }) < 0.01);
        CHECK(std::abs(volumeLost(shape, medial)) < 0.01);
    }
}

TEST_CASE("a thin plate of 12 triangles has a sheet half way through it") {
    const glm::vec3 high(4, 4, 0.1F);
    const Shape shape = box(glm::vec3(0), high);
    const MedialSurface medial = medialOf(shape);
    CHECK(farthest(shape, medial, [&](const Sample& s) {
              return belowFace(s, glm::dvec3(0), glm::dvec3(high));
          }) < 0.01);
    CHECK(std::abs(volumeLost(shape, medial)) < 0.01);
}

TEST_CASE("the medial surface of a sphere is its centre") {
    const glm::vec3 centre(3, 2, 1);
    for (const Shape& shape :
         {icosphere(centre, 2, 2), icosphere(centre, 2, 5), sphere(centre, glm::vec3(2), 16),
          sphere(centre, glm::vec3(2), 40)}) {
        const MedialSurface medial = medialOf(shape);
        CHECK(farthest(shape, medial, [&](const Sample&) { return glm::dvec3(centre); }) < 0.01);
        CHECK(std::abs(volumeLost(shape, medial)) < 0.01);
    }
}

TEST_CASE("the medial surface of a torus is its centre circle") {
    for (const uint32_t fineness : {1U, 2U, 4U}) {
        const Shape shape = torusShape(2, 0.5F, 48 * fineness, 16 * fineness);
        const MedialSurface medial = medialOf(shape);
        CHECK(farthest(shape, medial, [](const Sample& s) {
                  const double across = std::hypot(s.point.x, s.point.y);
                  return glm::dvec3(2 * s.point.x / across, 2 * s.point.y / across, 0);
              }) < 0.01);
        CHECK(std::abs(volumeLost(shape, medial)) < 0.01);
    }
}

TEST_CASE("the medial surface of a capsule is its axis") {
    // Where caps and sides meet, a normal is uncertain by half a facet: with fewer than 40 rings
    // that alone is one percent of the diagonal.
    for (const int n : {48, 64}) {
        const Shape shape = capsule(0.5F, 1.5F, n);
        const MedialSurface medial = medialOf(shape);
        CHECK(farthest(shape, medial, [](const Sample& s) {
                  return glm::dvec3(0, 0, std::clamp(s.point.z, -1.5, 1.5));
              }) < 0.01);
        CHECK(std::abs(volumeLost(shape, medial)) < 0.01);
    }
}

TEST_CASE("the medial surface of a double-walled vase is in the middle of its walls and floor") {
    const std::vector<glm::dvec2> profile{{0.2, 0}, {1, 0},     {1, 2},
                                          {0.9, 2}, {0.9, 0.1}, {0.2, 0.1}};
    const Shape shape = lathe(profile, 96);
    const MedialSurface medial = medialOf(shape);
    const std::vector<glm::dvec2> axis = medialAxisOf(profile);
    double worst = 0;
    for (const Sample& s : samplesOf(shape, medial, 4000)) {
        const glm::dvec2 inner(std::hypot(s.inner.x, s.inner.y), s.inner.z);
        double nearest = INFINITY;
        for (const glm::dvec2& p : axis) nearest = std::min(nearest, glm::distance(p, inner));
        worst = std::max(worst, nearest);
    }
    CHECK(worst < 0.01 * diagonalOf(shape));
    CHECK(std::abs(volumeLost(shape, medial)) < 0.01);
}

TEST_CASE("the inner points of a shell thinner than its vertices are apart stay in its wall") {
    Shape shell = icosphere({0, 0, 0}, 1, 3);  // edges of 0.14
    Shape hollow = icosphere({0, 0, 0}, 0.95F, 3);
    hollow.transform([](glm::vec3 p) {
        return glm::vec3(0.8F * p.x - 0.6F * p.y, 0.6F * p.x + 0.8F * p.y, p.z);
    });
    for (auto& t : hollow.triangles) std::swap(t[0], t[1]);
    shell.append(hollow);
    const MedialSurface medial = medialOf(shell);
    float deepest = 0;
    for (size_t v = 0; v < shell.positions.size(); ++v)
        deepest = std::max(deepest, glm::distance(medial.points[v], shell.positions[v]));
    CHECK(deepest < 0.04F);  // half the wall is 0.025
}

TEST_CASE("a small bump has a branch of its own only without the scale axis and the angle filter") {
    Shape bumpy = icosphere({0, 0, 0}, 1, 4);
    bumpy.transform([](glm::vec3 p) {
        const float away = glm::distance(p, glm::vec3(0, 0, 1));
        return p * (1 + 0.06F * std::exp(-away * away / 0.005F));
    });
    MedialOptions options;
    options.preSmoothing = 0;
    const auto deepestBelowBump = [&] {
        const MedialSurface medial = medialOf(bumpy, options);
        float highest = 0;
        for (const glm::vec3& p : medial.points) highest = std::max(highest, p.z);
        return highest;
    };
    CHECK(deepestBelowBump() < 0.5F);
    options.scaleAxis = 1;
    options.separationAngle = 5;
    CHECK(deepestBelowBump() > 0.7F);
    options.smallestRadius = 0.2;  // of the diagonal: the circumradius filter alone
    CHECK(deepestBelowBump() < 0.5F);
}

TEST_CASE("parts keep to themselves, and a point without triangles stays") {
    Shape two = icosphere({0, 0, 0}, 1, 3);
    const size_t first = two.positions.size();
    two.append(icosphere({5, 0, 0}, 1, 3));
    SurfaceMesh mesh = two.mesh();
    mesh.positions.emplace_back(2.5F, 0.0F, 0.0F);
    const MedialSurface medial = medialOf(mesh);
    for (size_t v = 0; v < two.positions.size(); ++v)
        CHECK(glm::distance(medial.points[v], {v < first ? 0 : 5, 0, 0}) < 0.1F);
    CHECK(medial.points[two.positions.size()] == glm::vec3(2.5F, 0, 0));
}

TEST_CASE("open and inside-out surfaces work and nothing leaves them") {
    Shape open = box({0, 0, 0}, {1, 1, 1}, 6);
    std::erase_if(open.triangles, [&](const auto& t) {
        return open.positions[t[0]].z == 1 && open.positions[t[1]].z == 1 &&
               open.positions[t[2]].z == 1;
    });
    uint32_t moved = 0;
    const MedialSurface medial = medialOf(open);
    for (size_t v = 0; v < open.positions.size(); ++v) {
        if (medial.points[v] != open.positions[v]) ++moved;
    }
    CHECK(moved > open.positions.size() / 2);

    Shape turned = box({0, 0, 0}, {1, 1, 1}, 3);
    for (auto& t : turned.triangles) std::swap(t[0], t[1]);
    const MedialSurface none = medialOf(turned);
    for (size_t v = 0; v < turned.positions.size(); ++v)
        CHECK(glm::distance(none.points[v], turned.positions[v]) < 1e-5F);
}

TEST_CASE("overlapping and touching parts are one solid") {
    Shape parts = box({0, 0, 0}, {2, 2, 2}, 4);
    parts.append(box({1, 1, 1}, {3, 3, 3}, 4));
    parts.append(box({2, 0, 0}, {3, 1, 1}, 1));
    medialOf(parts);
}

TEST_CASE("the thesis' own medial surface is that of the poles") {
    MedialOptions options;
    options.thesis = true;
    const Shape shape = torusShape(2, 0.5F, 48, 16);
    const MedialSurface medial = medialOf(shape, options);
    CHECK(medial.points.size() == shape.positions.size());
    CHECK(medial.delaunaySeconds > 0);
    medialOf(box({0, 0, 0}, {4, 4, 0.5F}, 12), options);
}

TEST_CASE("scaling by powers of two scales the medial surface bit by bit; threads change nothing") {
    Random random(99);
    Shape shape = torusShape(2, 0.5F, 120, 48);  // enough vertices that some learn from others
    shape.append(box({0, 0, -0.1F}, {0.5F, 0.5F, 0.1F}));
    shape.transform([&](glm::vec3 p) {
        return p + glm::vec3(7, 0, 0) +
               0.05F * glm::vec3(random.unit(), random.unit(), random.unit());
    });
    MedialOptions options;
    options.preSmoothing = 1;
    const MedialSurface base = medialOf(shape, options);
    CHECK(base.covered > 0);
    for (const int exponent : {-20, -1, 1, 30}) {
        Shape scaled = shape;
        scaled.transform([&](glm::vec3 p) { return p * std::ldexp(1.0F, exponent); });
        options.threads = exponent > 0 ? 1 : 3;
        const MedialSurface medial = medialOf(scaled, options);
        REQUIRE(medial.points.size() == base.points.size());
        bool same = true;
        for (size_t v = 0; v < base.points.size(); ++v)
            same = same && medial.points[v] == base.points[v] * std::ldexp(1.0F, exponent);
        CHECK(same);
    }
}

TEST_CASE("random triangle soups of hostile shape neither crash nor leave the solid") {
    Random random(4711);
    for (int round = 0; round < propertyCases(100); ++round) {
        SurfaceMesh mesh;
        const uint32_t points = 1 + random.below(30);
        const int steps = round % 3 == 0 ? 2 : (round % 3 == 1 ? 5 : 1000000);
        for (uint32_t i = 0; i < points; ++i) {
            glm::vec3 p;
            for (int k = 0; k < 3; ++k) {
                p[k] = static_cast<float>(std::round(random.unit() * steps) / steps);
            }
            mesh.positions.push_back(p);
        }
        for (uint32_t i = random.below(60); i > 0; --i) {
            mesh.triangles.push_back(
                {random.below(points), random.below(points), random.below(points)});
        }
        INFO("round " << round);
        medialOf(mesh);
    }
}
