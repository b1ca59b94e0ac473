// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "geometry/inside_test.h"
#include "geometry/triangle_bvh.h"
#include "geometry/voronoi.h"
#include "interior/pole_medial.h"
#include "interior/shapes.h"
#include "support/property.h"

using namespace sherd;
using namespace sherd::test;

namespace {

/// The medial surface, with the promise checked that nothing is outside.
PoleMedialSurface poleMedialOf(const SurfaceMesh& mesh, const PoleMedialOptions& options = {}) {
    const Result<PoleMedialSurface> result = poleMedialSurface(mesh, options);
    REQUIRE(result.has_value());
    REQUIRE(result->points.size() == mesh.positions.size());
    const InsideTest inside(mesh.positions, mesh.triangles);
    uint32_t outside = 0;
    for (size_t v = 0; v < mesh.positions.size(); ++v) {
        const glm::vec3 p = result->points[v];
        if (p != mesh.positions[v] && !inside.inside(glm::dvec3(p))) ++outside;
    }
    CHECK(outside == 0);
    return *result;
}

PoleMedialSurface poleMedialOf(const Shape& shape) {
    return poleMedialOf(shape.mesh());
}

/// How many points are as `allowed` says, 0..1.
double share(const std::vector<glm::vec3>& points, const auto& allowed) {
    const auto count = std::count_if(points.begin(), points.end(), allowed);
    return static_cast<double>(count) / static_cast<double>(points.size());
}

}  // namespace

TEST_CASE("an empty mesh has an empty medial surface") {
    CHECK(poleMedialOf(SurfaceMesh{}).points.empty());
    SurfaceMesh cloud;
    cloud.positions = {{0, 0, 0}, {1, 2, 3}};
    const PoleMedialSurface medial = poleMedialOf(cloud);
    CHECK(medial.points == cloud.positions);
    CHECK(medial.onSurface == 2);
}

TEST_CASE("smoothing steps out of range are refused with the range") {
    PoleMedialOptions options;
    options.preSmoothing = -1;
    const Result<PoleMedialSurface> result =
        poleMedialSurface(box({0, 0, 0}, {1, 1, 1}).mesh(), options);
    REQUIRE_FALSE(result.has_value());
    CHECK(result.error().code == ErrorCode::badArgument);
    CHECK(result.error().message.find("0 to 1000") != std::string::npos);
}

TEST_CASE("surfaces in one plane or one point stay where they are, with a word about it") {
    SurfaceMesh flat;
    flat.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 2, 0}, {0, 2, 0}};
    flat.triangles = {{0, 1, 2}, {0, 2, 3}, {2, 4, 5}};
    CHECK(poleMedialOf(flat).points == flat.positions);
    CHECK(poleMedialOf(flat).warnings.size() == 1);

    SurfaceMesh twoSided = flat;
    twoSided.triangles = {{0, 1, 2}, {0, 2, 1}};
    CHECK(poleMedialOf(twoSided).points == flat.positions);

    SurfaceMesh point;
    point.positions = {{3, 3, 3}};
    point.triangles = {{0, 0, 0}};
    CHECK(poleMedialOf(point).points == point.positions);
}

TEST_CASE("Voronoi vertices of degenerate sites are errors, never the end of the process") {
    CHECK_FALSE(voronoiVertices({}).has_value());
    const std::vector<glm::dvec3> same(10, glm::dvec3(0.5));
    CHECK_FALSE(voronoiVertices(same).has_value());
    std::vector<glm::dvec3> line;
    line.reserve(10);
    for (int i = 0; i < 10; ++i) line.emplace_back(i * 0.1, 0, 0);
    const Result<VoronoiVertices> none = voronoiVertices(line);
    REQUIRE_FALSE(none.has_value());
    CHECK(none.error().message.find("Qhull") != std::string::npos);
}

TEST_CASE("the eight corners of a cube have one Voronoi vertex, its centre") {
    std::vector<glm::dvec3> corners;
    corners.reserve(8);
    for (int i = 0; i < 8; ++i) corners.emplace_back(i & 1, i >> 1 & 1, i >> 2);
    const Result<VoronoiVertices> voronoi = voronoiVertices(corners);
    REQUIRE(voronoi.has_value());
    REQUIRE_FALSE(voronoi->points.empty());
    for (const glm::dvec3& p : voronoi->points) {
        CHECK(glm::distance(p, glm::dvec3(0.5)) < 1e-12);
    }
}

TEST_CASE("the inner points of a torus lie on its centre circle") {
    const PoleMedialSurface medial = poleMedialOf(torusShape(2, 0.5F, 96, 32));
    for (const glm::vec3& p : medial.points) {
        CHECK(std::abs(std::sqrt(p.x * p.x + p.y * p.y) - 2) <
              0.12F);  // the poles are smoothed, too
        CHECK(std::abs(p.z) < 0.02F);
    }
}

TEST_CASE("the inner points of a plate lie halfway through it") {
    const Shape plate = box({0, 0, 0}, {4, 4, 0.5F}, 24);
    const PoleMedialSurface medial = poleMedialOf(plate);
    for (size_t v = 0; v < medial.points.size(); ++v) {
        const glm::vec3 p = plate.positions[v];
        const bool away = p.x > 0.8F && p.x < 3.2F && p.y > 0.8F && p.y < 3.2F;
        if (away) CHECK(medial.points[v].z == doctest::Approx(0.25).epsilon(0.02));
    }
}

TEST_CASE("parts keep to themselves, and a point without triangles stays") {
    Shape two = icosphere({0, 0, 0}, 1, 3);
    const size_t first = two.positions.size();
    two.append(icosphere({5, 0, 0}, 1, 3));
    SurfaceMesh mesh = two.mesh();
    mesh.positions.emplace_back(2.5F, 0.0F, 0.0F);
    const PoleMedialSurface medial = poleMedialOf(mesh);
    for (size_t v = 0; v < two.positions.size(); ++v) {
        CHECK(glm::distance(medial.points[v], {v < first ? 0 : 5, 0, 0}) < 0.6F);
    }
    CHECK(medial.points.back() == glm::vec3(2.5F, 0, 0));
}

TEST_CASE("open and inside-out surfaces work and nothing leaves them") {
    Shape open = box({0, 0, 0}, {1, 1, 1}, 6);
    std::erase_if(open.triangles, [&](const auto& t) {
        return open.positions[t[0]].z == 1 && open.positions[t[1]].z == 1 &&
               open.positions[t[2]].z == 1;
    });
    uint32_t moved = 0;
    const PoleMedialSurface medial = poleMedialOf(open);
    for (size_t v = 0; v < open.positions.size(); ++v) {
        if (medial.points[v] != open.positions[v]) ++moved;
    }
    CHECK(moved > open.positions.size() / 2);

    Shape turned = box({0, 0, 0}, {1, 1, 1}, 3);
    for (auto& t : turned.triangles) std::swap(t[0], t[1]);
    CHECK(poleMedialOf(turned).points == turned.positions);
}

TEST_CASE("overlapping and touching parts are one solid") {
    Shape parts = box({0, 0, 0}, {2, 2, 2}, 4);
    parts.append(box({1, 1, 1}, {3, 3, 3}, 4));
    parts.append(box({2, 0, 0}, {3, 1, 1}, 1));
    poleMedialOf(parts);
}

TEST_CASE("scaling by powers of two scales the medial surface bit by bit; threads change nothing") {
    Random random(99);
    Shape shape = torusShape(2, 0.5F, 40, 16);
    shape.append(box({0, 0, -0.1F}, {0.5F, 0.5F, 0.1F}));
    shape.transform([&](glm::vec3 p) {
        return p + glm::vec3(7, 0, 0) +
               0.15F * glm::vec3(random.unit(), random.unit(), random.unit());
    });
    const PoleMedialSurface base = poleMedialOf(shape);
    CHECK(base.outside > 0);  // so that the ladder is scaled too
    for (const int exponent : {-20, -1, 1, 30}) {
        Shape scaled = shape;
        scaled.transform([&](glm::vec3 p) { return p * std::ldexp(1.0F, exponent); });
        PoleMedialOptions options;
        options.threads = exponent > 0 ? 1 : 3;
        const PoleMedialSurface medial = poleMedialOf(scaled.mesh(), options);
        bool same = true;
        for (size_t v = 0; v < base.points.size(); ++v) {
            same = same && medial.points[v] == base.points[v] * std::ldexp(1.0F, exponent);
        }
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
        poleMedialOf(mesh);
    }
}
