// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <map>

#include "geometry/bisection.h"
#include "geometry/triangle.h"
#include "interior/shapes.h"
#include "support/property.h"
#include "surface/mesh_topology.h"

using namespace sherd;
using namespace sherd::test;

namespace {

constexpr uint32_t kNo = BisectedTriangles::kNone;

struct Refined {
    std::vector<glm::vec3> positions;
    BisectedTriangles mesh;

    double length2(uint32_t h) const {
        const auto& v = mesh.triangles[h / 3].v;
        const glm::vec3 d = positions[v[h % 3]] - positions[v[(h + 1) % 3]];
        return glm::dot(d, d);
    }
    void cut(std::vector<uint8_t> marked) {
        const auto length = [&](uint32_t h) { return length2(h); };
        std::vector<uint32_t> marks;
        for (uint32_t h = 0; h < marked.size(); ++h)
            if (marked[h] != 0) marks.push_back(h);
        closeMarks(mesh, length, marks, marked);
        CHECK(std::count(marked.begin(), marked.end(), 1) == std::ssize(marks));
        const size_t before = positions.size();
        std::vector<uint32_t> middle(marked.size(), kNo);
        for (uint32_t h = 0; h < marked.size(); ++h) {
            if (marked[h] == 0 || middle[h] != kNo) continue;
            const auto& v = mesh.triangles[h / 3].v;
            middle[h] = static_cast<uint32_t>(positions.size());
            if (mesh.opposite[h] != kNo) middle[mesh.opposite[h]] = middle[h];
            positions.push_back((positions[v[h % 3]] + positions[v[(h + 1) % 3]]) / 2.0F);
        }
        std::vector<uint8_t> kept(marked.size(), 1);
        bisect(mesh, marked, middle, length, &kept);
        bool keepsWhole = kept.size() == mesh.opposite.size();
        for (uint32_t h = 0; h < kept.size() && keepsWhole; ++h) {
            const auto& v = mesh.triangles[h / 3].v;
            const bool isWhole = std::max(v[h % 3], v[(h + 1) % 3]) < before;
            keepsWhole = (kept[h] != 0) == isWhole;
        }
        CHECK(keepsWhole);
        sortByParent(mesh);
    }
};

/// No hanging vertex: each side's opposite is that side the other way round, and as many sides have
/// none as before.
bool isGlued(const BisectedTriangles& mesh) {
    for (uint32_t h = 0; h < mesh.opposite.size(); ++h) {
        const uint32_t o = mesh.opposite[h];
        if (o == kNo) continue;
        const auto &v = mesh.triangles[h / 3].v, &w = mesh.triangles[o / 3].v;
        if (mesh.opposite[o] != h || v[h % 3] != w[(o + 1) % 3] || v[(h + 1) % 3] != w[o % 3])
            return false;
    }
    return true;
}

}  // namespace

TEST_CASE("refining a mesh at random leaves no hanging vertex, no hole and no lost area") {
    Random random(5);
    for (int round = 0; round < propertyCases(40); ++round) {
        Shape shape = round % 2 == 0 ? box({0, 0, 0}, {1, 2, 3}) : icosphere({0, 0, 0}, 1, 1);
        if (round % 4 == 3) shape.triangles.resize(shape.triangles.size() / 2);  // open
        const MeshTopology topology = buildTopology(shape.positions, shape.triangles);
        Refined refined{shape.positions, BisectedTriangles(shape.triangles, topology.opposite)};
        double area = 0;
        for (const auto& t : shape.triangles) area += triangleArea(shape.positions, t);
        for (int step = 0; step < 5; ++step) {
            std::vector<uint8_t> marked(refined.mesh.opposite.size(), 0);
            for (uint8_t& m : marked) m = random.below(6) == 0 ? 1 : 0;
            refined.cut(std::move(marked));
            INFO("round " << round << ", step " << step);
            CHECK(isGlued(refined.mesh));
            double now = 0;
            bool sorted = true, alongParents = true;
            const auto& triangles = refined.mesh.triangles;
            for (size_t t = 0; t < triangles.size(); ++t) {
                now += triangleArea(refined.positions, triangles[t].v);
                sorted = sorted && (t == 0 || triangles[t - 1].parent <= triangles[t].parent);
                for (uint32_t k = 0; k < 3; ++k) {
                    const uint32_t along = triangles[t].along[k];
                    if (along == kNo) continue;
                    alongParents = alongParents && along / 3 == triangles[t].parent;
                    const auto& p = shape.triangles[along / 3];
                    const glm::dvec3 a = shape.positions[p[along % 3]];
                    const glm::dvec3 b = shape.positions[p[(along + 1) % 3]];
                    for (const uint32_t end : {triangles[t].v[k], triangles[t].v[(k + 1) % 3]}) {
                        const glm::dvec3 q = refined.positions[end];
                        alongParents = alongParents && glm::length(glm::cross(q - a, b - a)) < 1e-5;
                    }
                }
            }
            CHECK(now == doctest::Approx(area).epsilon(1e-5));
            CHECK(sorted);
            CHECK(alongParents);
        }
    }
}

TEST_CASE("a place of a parent is found in the triangle that holds it now") {
    Random random(6);
    const Shape shape = box({0, 0, 0}, {1, 2, 3});
    const MeshTopology topology = buildTopology(shape.positions, shape.triangles);
    Refined refined{shape.positions, BisectedTriangles(shape.triangles, topology.opposite)};
    for (int step = 0; step < 6; ++step) {
        std::vector<uint8_t> marked(refined.mesh.opposite.size(), 0);
        for (uint8_t& m : marked) m = random.below(4) == 0 ? 1 : 0;
        refined.cut(std::move(marked));
    }
    double worst = 0, most = 0;
    for (int i = 0; i < 2000; ++i) {
        const uint32_t parent = random.below(static_cast<uint32_t>(shape.triangles.size()));
        glm::dvec3 w(random.unit(), random.unit(), i % 5 == 0 ? 0 : random.unit());
        w /= w.x + w.y + w.z;
        const auto [v, inner] = refined.mesh.locate(parent, w);
        glm::dvec3 expected(0.0), found(0.0);
        for (int k = 0; k < 3; ++k) {
            expected += w[k] * glm::dvec3(shape.positions[shape.triangles[parent][k]]);
            found += inner[k] * glm::dvec3(refined.positions[v[k]]);
            most = std::max(most, -inner[k]);
        }
        worst = std::max(worst, glm::distance(expected, found));
    }
    CHECK(worst < 1e-6);
    CHECK(most < 1e-12);  // never outside of it
}

TEST_CASE("halving marked sides alone keeps the angles of triangles away from zero") {
    const Shape shape = icosphere({0, 0, 0}, 1, 0);
    const MeshTopology topology = buildTopology(shape.positions, shape.triangles);
    Refined refined{shape.positions, BisectedTriangles(shape.triangles, topology.opposite)};
    for (int step = 0; step < 12; ++step) {
        // Always around one vertex.
        std::vector<uint8_t> marked(refined.mesh.opposite.size(), 0);
        for (uint32_t h = 0; h < marked.size(); ++h)
            if (refined.mesh.triangles[h / 3].v[h % 3] == 0) marked[h] = 1;
        refined.cut(std::move(marked));
    }
    double flattest = 1;
    for (const auto& t : refined.mesh.triangles) {
        const glm::dvec3 a = refined.positions[t.v[0]], b = refined.positions[t.v[1]],
                         c = refined.positions[t.v[2]];
        const double longest =
            std::max({glm::distance(a, b), glm::distance(b, c), glm::distance(c, a)});
        flattest = std::min(flattest, glm::length(glm::cross(b - a, c - a)) / (longest * longest));
    }
    CHECK(flattest > 0.2);
}
