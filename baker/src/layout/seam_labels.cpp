// SPDX-License-Identifier: MIT
// Which chart borders belong together. A seam edge has two drawn copies; stretches run on over a
// vertex only where both copies do, so a stretch has one chart on each of its sides.
#include "layout/seam_labels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <tuple>

#include "layout/drawn_triangle.h"
#include "layout/uv_wireframe.h"
#include "surface/mesh_topology.h"

namespace sherd {

namespace {

using Drawn = std::array<glm::dvec2, 2>;

bool less(const glm::dvec2& a, const glm::dvec2& b) {
    return std::tie(a.x, a.y) < std::tie(b.x, b.y);
}

/// A vertex of a seam with its places on the two charts, the lesser first.
struct SeamNode {
    uint32_t vertex;
    Drawn places;
    bool operator<(const SeamNode& other) const {
        if (vertex != other.vertex) return vertex < other.vertex;
        if (places[0] != other.places[0]) return less(places[0], other.places[0]);
        return less(places[1], other.places[1]);
    }
    bool operator==(const SeamNode& other) const {
        return vertex == other.vertex && places == other.places;
    }
};

struct SeamEdge {
    std::array<SeamNode, 2> ends;
    std::array<Drawn, 2> sides;       ///< [side][end]
    std::array<glm::dvec2, 2> third;  ///< the other corner of the triangle on each side
};

SeamNode nodeAt(uint32_t vertex, const glm::dvec2& a, const glm::dvec2& b) {
    return less(b, a) ? SeamNode{vertex, {b, a}} : SeamNode{vertex, {a, b}};
}

std::vector<SeamEdge> seamEdges(const SurfaceMesh& mesh) {
    std::vector<SeamEdge> edges;
    const DrawnMesh drawn(mesh);
    if (drawn.size() == 0) return edges;
    const MeshTopology topology = buildTopology(mesh.positions, mesh.triangles);
    for (uint32_t h = 0; h < topology.opposite.size(); ++h) {
        const uint32_t o = topology.opposite[h];
        if (o == kNone || o < h) continue;
        const auto here = drawn[h / 3].points;
        const auto there = drawn[o / 3].points;
        const Drawn a = {here[h % 3], here[(h % 3 + 1) % 3]};
        const Drawn b = {there[(o % 3 + 1) % 3], there[o % 3]};
        const auto finite = [](const glm::dvec2& p) {
            return std::isfinite(p.x) && std::isfinite(p.y);
        };
        if (a == b || !finite(a[0]) || !finite(a[1]) || !finite(b[0]) || !finite(b[1])) continue;
        const uint32_t from = mesh.triangles[h / 3][h % 3];
        const uint32_t to = mesh.triangles[o / 3][o % 3];
        edges.push_back({{nodeAt(from, a[0], b[0]), nodeAt(to, a[1], b[1])},
                         {a, b},
                         {here[(h % 3 + 2) % 3], there[(o % 3 + 2) % 3]}});
    }
    return edges;
}

double lengthOf(const SeamEdge& edge) {
    const double a = glm::distance(edge.sides[0][0], edge.sides[0][1]);
    const double b = glm::distance(edge.sides[1][0], edge.sides[1][1]);
    return std::min(a, b);
}

glm::dvec2 inwardOf(const Drawn& side, const glm::dvec2& third) {
    const glm::dvec2 along = side[1] - side[0];
    glm::dvec2 normal(-along.y, along.x);
    if (glm::dot(normal, third - side[0]) < 0) normal = -normal;
    const double length = glm::length(normal);
    return length > 0 ? normal / length : glm::dvec2(0.0);
}

SeamLabel labelAt(const SeamEdge& edge, double length) {
    SeamLabel label;
    label.length = length;
    for (size_t side = 0; side < 2; ++side) {
        label.at[side] = (edge.sides[side][0] + edge.sides[side][1]) * 0.5;
        label.inward[side] = inwardOf(edge.sides[side], edge.third[side]);
    }
    return label;
}

/// A long stretch is numbered again and again, so that one end does not look for the other.
void labelStretch(const std::vector<const SeamEdge*>& stretch, std::vector<SeamLabel>& labels) {
    constexpr double kLongest = 0.3;
    constexpr double kMostParts = 64;
    double whole = 0;
    for (const SeamEdge* edge : stretch) whole += lengthOf(*edge);
    const double parts = std::clamp(std::ceil(whole / kLongest), 1.0, kMostParts);
    double passed = 0;
    double next = 0.5;
    for (const SeamEdge* edge : stretch) {
        passed += lengthOf(*edge);
        if (next > parts || passed * parts < next * whole) continue;
        labels.push_back(labelAt(*edge, whole / parts));
        // Parts that end on this edge already have this number.
        while (next <= parts && passed * parts >= next * whole) next += 1;
    }
}

void addLabels(const std::vector<SeamEdge>& seams, std::vector<SeamLabel>& labels) {
    std::vector<SeamNode> nodes;
    for (const SeamEdge& edge : seams)
        nodes.insert(nodes.end(), edge.ends.begin(), edge.ends.end());
    std::sort(nodes.begin(), nodes.end());
    std::vector<SeamNode> all = nodes;
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    const auto timesUsed = [&](const SeamNode& node) {
        const auto [first, last] = std::equal_range(all.begin(), all.end(), node);
        return last - first;
    };
    // Chains are walked from low numbers on, so a stretch's ends must come before its middle.
    const auto inner = std::stable_partition(
        nodes.begin(), nodes.end(), [&](const SeamNode& node) { return timesUsed(node) == 1; });
    const auto idOf = [&](const SeamNode& node) {
        auto found = std::lower_bound(nodes.begin(), inner, node);
        if (found == inner || !(*found == node)) found = std::lower_bound(inner, nodes.end(), node);
        return static_cast<uint32_t>(found - nodes.begin());
    };
    std::vector<std::pair<std::array<uint32_t, 2>, const SeamEdge*>> ofEnds;
    std::vector<std::array<uint32_t, 2>> edges;
    for (const SeamEdge& edge : seams) {
        const uint32_t a = idOf(edge.ends[0]);
        const uint32_t b = idOf(edge.ends[1]);
        edges.push_back({std::min(a, b), std::max(a, b)});
        ofEnds.emplace_back(edges.back(), &edge);
    }
    std::sort(ofEnds.begin(), ofEnds.end());
    for (const std::vector<uint32_t>& chain : chainEdges(nodes.size(), edges)) {
        std::vector<const SeamEdge*> stretch;
        for (size_t i = 1; i < chain.size(); ++i) {
            const std::array<uint32_t, 2> ends = {std::min(chain[i - 1], chain[i]),
                                                  std::max(chain[i - 1], chain[i])};
            const auto found = std::lower_bound(
                ofEnds.begin(), ofEnds.end(), ends,
                [](const auto& entry, const auto& wanted) { return entry.first < wanted; });
            stretch.push_back(found->second);
        }
        labelStretch(stretch, labels);
    }
}

}  // namespace

std::vector<SeamLabel> seamLabels(std::span<const SurfaceMesh> meshes) {
    std::vector<SeamLabel> labels;
    for (const SurfaceMesh& mesh : meshes) addLabels(seamEdges(mesh), labels);
    std::stable_sort(labels.begin(), labels.end(),
                     [](const SeamLabel& a, const SeamLabel& b) { return a.length > b.length; });
    return labels;
}

}  // namespace sherd
