// SPDX-License-Identifier: MIT
#include "volume/prism_vertices.h"

#include <algorithm>
#include <utility>

namespace sherd {
namespace {

using Integer = ExactPlace::Integer;

glm::dvec3 asDouble(const CutGridPoint& p) {
    return {p.x, p.y, p.z};
}

}  // namespace

PrismVertices::PrismVertices(const PrismInput& input)
    : input_(input), meshCount_(static_cast<uint32_t>(input.positions.size())) {
    for (const CutGridPoint& p : input.points) grid_.push_back(asDouble(p));
    world_.assign(input.positions.begin(), input.positions.end());
}

uint32_t PrismVertices::add(const Made& made, const glm::dvec3& grid, const glm::dvec3& world) {
    keys_.add({static_cast<uint32_t>(made.kind), made.of[0], made.of[1], made.of[2]});
    made_.push_back(made);
    grid_.push_back(grid);
    world_.emplace_back(world);
    return count() - 1;
}

uint32_t PrismVertices::find(Kind kind, const std::array<uint32_t, 3>& of) const {
    const uint32_t key = keys_.find({static_cast<uint32_t>(kind), of[0], of[1], of[2]});
    return key == KeyTable::kNone ? kNone : meshCount_ + key;
}

uint32_t PrismVertices::onEdge(uint32_t u, uint32_t v, uint32_t line) {
    if (u > v) std::swap(u, v);
    const std::array<uint32_t, 3> of{u, v, line};
    if (const uint32_t known = find(Kind::edge, of); known != kNone) return known;
    const Integer atU = input_.map.valueAt(input_.planar(u), line);
    const Integer atV = input_.map.valueAt(input_.planar(v), line);
    const auto whole = Integer(atU - atV).convert_to<double>();
    const double t = atU.convert_to<double>() / whole, s = -atV.convert_to<double>() / whole;
    return add({Kind::edge, of, {s, t, 0}}, s * grid_[u] + t * grid_[v],
               s * glm::dvec3(input_.positions[u]) + t * glm::dvec3(input_.positions[v]));
}

/// The weights of a triangle's corners at a node, times their sum; below 2^121.
std::array<Int128, 3> PrismVertices::cornerWeights(uint32_t triangle, uint32_t node) const {
    const auto& t = input_.triangles[triangle];
    const PrismMap::Node& n = input_.map.node(node);
    std::array<Int128, 3> weights{};
    for (size_t k = 0; k < 3; ++k) {
        const PlanePoint u = input_.planar(t[(k + 1) % 3]), v = input_.planar(t[(k + 2) % 3]);
        const int64_t x = u.y - v.y, y = v.x - u.x;
        weights[k] = n.x * x + n.y * y - n.w * (x * u.x + y * u.y);
    }
    return weights;
}

uint32_t PrismVertices::atNode(uint32_t triangle, uint32_t node) {
    const std::array<uint32_t, 3> of{triangle, node, 0};
    if (const uint32_t known = find(Kind::node, of); known != kNone) return known;
    const std::array<Int128, 3> exact = cornerWeights(triangle, node);
    const auto sum = static_cast<double>(exact[0] + exact[1] + exact[2]);
    const auto& t = input_.triangles[triangle];
    glm::dvec3 weights, grid(0), world(0);
    // Sums depend on their order: from both sides of a triangle it is that of the vertices.
    std::array<size_t, 3> in{0, 1, 2};
    if (input_.shared)
        std::sort(in.begin(), in.end(), [&](size_t a, size_t b) { return t[a] < t[b]; });
    for (const size_t corner : in) {
        const auto k = static_cast<int>(corner);
        weights[k] = static_cast<double>(exact[corner]) / sum;
        grid += weights[k] * grid_[t[corner]];
        world += weights[k] * glm::dvec3(input_.positions[t[corner]]);
    }
    return add({Kind::node, of, weights}, grid, world);
}

int PrismVertices::compareDepth(uint32_t a, uint32_t b) const {
    const auto axis = static_cast<int>(input_.axis);
    const double apart = grid_[a][axis] - grid_[b][axis];
    // Places are off by 2^-23.
    if (apart > 0x1p-20) return 1;
    if (apart < -0x1p-20) return -1;
    const ExactPlace p = exactPlace(a), q = exactPlace(b);
    const auto depth = [axis](const ExactPlace& e) {
        return axis == 0 ? e.x : axis == 1 ? e.y : e.z;
    };
    if (const Integer d = depth(p) * q.w - depth(q) * p.w; d.sign() != 0) return d.sign();
    // How depths change as the drawing moves by (e^2, e).
    const ExactPlane f = trianglePlane(made_[a - meshCount_].of[0]);
    const ExactPlane g = trianglePlane(made_[b - meshCount_].of[0]);
    const size_t up = input_.axis;
    for (const size_t along : {(up + 2) % 3, (up + 1) % 3}) {
        const Integer d = g.of[along] * f.of[up] - f.of[along] * g.of[up];
        if (d.sign() != 0) return d.sign() * f.of[up].sign() * g.of[up].sign();
    }
    return 0;
}

glm::dvec3 PrismVertices::weights(uint32_t vertex, uint32_t triangle) const {
    const auto& t = input_.triangles[triangle];
    glm::dvec3 result(0);
    for (int k = 0; k < 3; ++k) {
        const uint32_t u = t[static_cast<size_t>(k)], v = t[static_cast<size_t>((k + 1) % 3)];
        if (vertex == u) {
            result[k] = 1;
            return result;
        }
        if (vertex < meshCount_) continue;
        const Made& made = made_[vertex - meshCount_];
        if (made.kind == Kind::node) return made.weights;
        if (std::min(u, v) != made.of[0] || std::max(u, v) != made.of[1]) continue;
        result[k] = u == made.of[0] ? made.weights.x : made.weights.y;
        result[(k + 1) % 3] = u == made.of[0] ? made.weights.y : made.weights.x;
        return result;
    }
    return result;
}

ExactPlane PrismVertices::trianglePlane(uint32_t triangle) const {
    const auto& t = input_.triangles[triangle];
    return planeThrough(input_.points[t[0]], input_.points[t[1]], input_.points[t[2]]);
}

ExactPlane PrismVertices::wallPlane(uint32_t line) const {
    const std::array<Integer, 3>& of = input_.map.line(line).of;
    ExactPlane plane;
    plane.of[(input_.axis + 1) % 3] = of[0];
    plane.of[(input_.axis + 2) % 3] = of[1];
    plane.of[3] = of[2];
    return plane;
}

ExactPlace PrismVertices::exactPlace(uint32_t vertex) const {
    const auto weighted = [&](std::initializer_list<std::pair<uint32_t, Integer>> corners) {
        ExactPlace p;
        for (const auto& [corner, weight] : corners) {
            const CutGridPoint& at = input_.points[corner];
            p.x += weight * at.x;
            p.y += weight * at.y;
            p.z += weight * at.z;
            p.w += weight;
        }
        if (p.w < 0) p = {-p.x, -p.y, -p.z, -p.w};
        return p;
    };
    if (vertex < meshCount_) return weighted({{vertex, 1}});
    const Made& made = made_[vertex - meshCount_];
    if (made.kind == Kind::edge) {
        const auto& [u, v, line] = made.of;
        return weighted({{u, -input_.map.valueAt(input_.planar(v), line)},
                         {v, input_.map.valueAt(input_.planar(u), line)}});
    }
    if (made.kind == Kind::node) {
        const std::array<Int128, 3> w = cornerWeights(made.of[0], made.of[1]);
        const auto& t = input_.triangles[made.of[0]];
        return weighted({{t[0], Integer(w[0])}, {t[1], Integer(w[1])}, {t[2], Integer(w[2])}});
    }
    return meet(trianglePlane(made.of[0]), trianglePlane(made.of[1]), wallPlane(made.of[2]));
}

glm::dvec3 PrismVertices::normal(uint32_t, uint32_t) const {
    // A line's value grows to its left.
    const std::array<Integer, 3>& of = input_.map.line(wall_).of;
    glm::dvec3 result(0);
    const double sign = turned_ ? 1 : -1;
    result[static_cast<int>((input_.axis + 1) % 3)] = sign * of[0].convert_to<double>();
    result[static_cast<int>((input_.axis + 2) % 3)] = sign * of[1].convert_to<double>();
    return result;
}

uint32_t PrismVertices::atCrossing(uint32_t s, uint32_t t, uint32_t, uint32_t) {
    if (s > t) std::swap(s, t);
    const std::array<uint32_t, 3> of{s, t, wall_};
    if (const uint32_t known = find(Kind::crossing, of); known != kNone) return known;
    const ExactPlace place = meet(trianglePlane(s), trianglePlane(t), wallPlane(wall_));
    if (place.w == 0) return kNone;
    const glm::dvec3 grid = rounded(place);
    return add({Kind::crossing, of, glm::dvec3(0)}, grid, input_.grid.toWorld(grid));
}

}  // namespace sherd
