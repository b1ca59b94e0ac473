// SPDX-License-Identifier: MIT
#include "volume/cut_vertex.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace sherd {
namespace {

using Integer = ExactPlace::Integer;

glm::dvec3 asDouble(const CutGridPoint& p) {
    return {p.x, p.y, p.z};
}

ExactPlane planeOf(const LinearFunction& f) {
    return {{Integer(f.x), Integer(f.y), Integer(f.z), Integer(f.c)}};
}

ExactPlace weighted(const std::array<CutGridPoint, 3>& corner,
                    const std::array<Int128, 3>& weight) {
    ExactPlace p;
    for (size_t k = 0; k < 3; ++k) {
        const Integer w(weight[k]);
        p.x += w * corner[k].x;
        p.y += w * corner[k].y;
        p.z += w * corner[k].z;
        p.w += w;
    }
    if (p.w < 0) p = {-p.x, -p.y, -p.z, -p.w};
    return p;
}

}  // namespace

CornerValues CutInput::cornerValues(uint32_t triangle, uint32_t i, uint32_t j) const {
    const LinearFunction f = functions[i] - functions[j];
    const auto& t = triangles[triangle];
    return {f.at(points[t[0]]), f.at(points[t[1]]), f.at(points[t[2]])};
}

CutVertices::CutVertices(const CutInput& input)
    : input_(input), meshCount_(static_cast<uint32_t>(input.positions.size())) {
    grid_.reserve(2 * size_t{meshCount_});
    world_.assign(input.positions.begin(), input.positions.end());
    for (const CutGridPoint& p : input.points) grid_.push_back(asDouble(p));
}

uint32_t CutVertices::add(Kind kind, uint32_t key, const glm::dvec3& weights,
                          const glm::dvec3& grid, const glm::dvec3& world) {
    const auto vertex = count();
    made_.push_back({kind, key, weights});
    grid_.push_back(grid);
    world_.emplace_back(world);
    vertexOfKey_[static_cast<size_t>(kind)].push_back(vertex);
    return vertex;
}

uint32_t CutVertices::onEdge(uint32_t u, uint32_t v, uint32_t i, uint32_t j) {
    if (u > v) std::swap(u, v);
    if (i > j) std::swap(i, j);
    const auto [key, isNew] = table(Kind::edge).add({u, v, i, j});
    if (!isNew) return vertexOfKey_[static_cast<size_t>(Kind::edge)][key];
    const LinearFunction f = input_.functions[i] - input_.functions[j];
    const int64_t atU = f.at(input_.points[u]);
    const int64_t atV = f.at(input_.points[v]);
    assert(atU != atV);
    const double t = static_cast<double>(atU) / static_cast<double>(atU - atV);
    const double s = static_cast<double>(atV) / static_cast<double>(atV - atU);
    const auto between = [&](const glm::dvec3& a, const glm::dvec3& b) { return s * a + t * b; };
    return add(Kind::edge, key, {s, t, 0}, between(grid_[u], grid_[v]),
               between(input_.positions[u], input_.positions[v]));
}

uint32_t CutVertices::inTriangle(uint32_t t, uint32_t i, uint32_t j, uint32_t k) {
    std::array<uint32_t, 3> cells{i, j, k};
    std::sort(cells.begin(), cells.end());
    const auto [key, isNew] = table(Kind::triangle).add({t, cells[0], cells[1], cells[2]});
    if (!isNew) return vertexOfKey_[static_cast<size_t>(Kind::triangle)][key];
    const auto exact = cornerWeights(input_.cornerValues(t, cells[0], cells[1]),
                                     input_.cornerValues(t, cells[0], cells[2]));
    const auto sum = static_cast<double>(exact[0] + exact[1] + exact[2]);
    const glm::dvec3 w(static_cast<double>(exact[0]) / sum, static_cast<double>(exact[1]) / sum,
                       static_cast<double>(exact[2]) / sum);
    const auto& v = input_.triangles[t];
    // Sums depend on their order: from both sides of a triangle it is that of the vertices.
    std::array<size_t, 3> in{0, 1, 2};
    if (input_.shared)
        std::sort(in.begin(), in.end(), [&](size_t a, size_t b) { return v[a] < v[b]; });
    const auto between = [&](const auto& at) {
        const auto part = [&](size_t n) {
            return w[static_cast<int>(in[n])] * glm::dvec3(at[v[in[n]]]);
        };
        return part(0) + part(1) + part(2);
    };
    return add(Kind::triangle, key, w, between(grid_), between(input_.positions));
}

uint32_t CutVertices::atCells(const std::array<uint32_t, 4>& cells, const glm::dvec3& position) {
    const auto [key, isNew] = table(Kind::cells).add(cells);
    if (!isNew) return vertexOfKey_[static_cast<size_t>(Kind::cells)][key];
    return add(Kind::cells, key, glm::dvec3(0), position, input_.grid.toWorld(position));
}

uint32_t CutVertices::atCrossing(uint32_t s, uint32_t t, uint32_t i, uint32_t j) {
    if (s > t) std::swap(s, t);
    if (i > j) std::swap(i, j);
    const KeyTable::Key crossing{s, t, i, j};
    if (const uint32_t known = table(Kind::crossing).find(crossing); known != kNone)
        return vertexOfKey_[static_cast<size_t>(Kind::crossing)][known];
    const ExactPlace place = crossingPlace(crossing);
    if (place.w == 0) return kNone;
    const uint32_t key = table(Kind::crossing).add(crossing).first;
    const glm::dvec3 grid = rounded(place);
    return add(Kind::crossing, key, glm::dvec3(0), grid, input_.grid.toWorld(grid));
}

ExactPlace CutVertices::crossingPlace(const KeyTable::Key& key) const {
    const auto corner = [&](uint32_t t, size_t k) { return input_.points[input_.triangles[t][k]]; };
    const auto plane = [&](uint32_t t) {
        return planeThrough(corner(t, 0), corner(t, 1), corner(t, 2));
    };
    return meet(plane(key[0]), plane(key[1]),
                planeOf(input_.functions[key[2]] - input_.functions[key[3]]));
}

glm::dvec3 CutVertices::normal(uint32_t i, uint32_t j) const {
    const LinearFunction f = input_.functions[i] - input_.functions[j];
    return {static_cast<double>(f.x), static_cast<double>(f.y), static_cast<double>(f.z)};
}

CutVertices::Kind CutVertices::kind(uint32_t vertex) const {
    return vertex < meshCount_ ? Kind::mesh : made_[vertex - meshCount_].kind;
}

ExactPlace CutVertices::exactPlace(uint32_t vertex) const {
    if (vertex < meshCount_) {
        const CutGridPoint& p = input_.points[vertex];
        return {p.x, p.y, p.z, 1};
    }
    const KeyTable::Key& key = keyOf(made_[vertex - meshCount_]);
    const auto& f = input_.functions;
    switch (made_[vertex - meshCount_].kind) {
        case Kind::edge: {
            const LinearFunction g = f[key[2]] - f[key[3]];
            const CutGridPoint& u = input_.points[key[0]];
            const CutGridPoint& v = input_.points[key[1]];
            return weighted({u, v, v}, {-g.at(v), g.at(u), 0});
        }
        case Kind::triangle: {
            const auto& t = input_.triangles[key[0]];
            return weighted({input_.points[t[0]], input_.points[t[1]], input_.points[t[2]]},
                            cornerWeights(input_.cornerValues(key[0], key[1], key[2]),
                                          input_.cornerValues(key[0], key[1], key[3])));
        }
        case Kind::cells:
            return meet(planeOf(f[key[1]] - f[key[0]]), planeOf(f[key[2]] - f[key[0]]),
                        planeOf(f[key[3]] - f[key[0]]));
        default:
            return crossingPlace(key);
    }
}

glm::dvec3 CutVertices::weights(uint32_t vertex, uint32_t triangle) const {
    const auto& t = input_.triangles[triangle];
    glm::dvec3 result(0);
    if (vertex < meshCount_) {
        for (int k = 0; k < 3; ++k)
            if (t[k] == vertex) {
                result[k] = 1;
                break;
            }
        return result;
    }
    const Made& made = made_[vertex - meshCount_];
    if (made.kind == Kind::triangle) return made.weights;
    assert(made.kind == Kind::edge);
    const KeyTable::Key& key = keyOf(made);
    for (int k = 0; k < 3; ++k) {
        const uint32_t u = t[k], v = t[(k + 1) % 3];
        if (std::min(u, v) != key[0] || std::max(u, v) != key[1]) continue;
        result[k] = u == key[0] ? made.weights.x : made.weights.y;
        result[(k + 1) % 3] = u == key[0] ? made.weights.y : made.weights.x;
        break;
    }
    return result;
}

}  // namespace sherd
