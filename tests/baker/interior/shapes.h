// SPDX-License-Identifier: MIT
// Closed surfaces made in code, outward orientation.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/vec3.hpp>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "sherd/baker/surface_mesh.h"

namespace sherd::test {

struct Shape {
    std::vector<glm::vec3> positions;
    std::vector<std::array<uint32_t, 3>> triangles;

    void append(const Shape& other) {
        const auto base = static_cast<uint32_t>(positions.size());
        positions.insert(positions.end(), other.positions.begin(), other.positions.end());
        for (const auto& t : other.triangles) {
            triangles.push_back({t[0] + base, t[1] + base, t[2] + base});
        }
    }
    void transform(const auto& f) {
        for (glm::vec3& p : positions) p = f(p);
    }
    SurfaceMesh mesh() const {
        SurfaceMesh m;
        m.positions = positions;
        m.triangles = triangles;
        return m;
    }
};

/// An axis-aligned box, each face n x n quads of two triangles, vertices welded.
inline Shape box(const glm::vec3& low, const glm::vec3& high, int n = 1) {
    Shape shape;
    std::map<std::array<int, 3>, uint32_t> ids;
    const auto vertex = [&](std::array<int, 3> g) {
        const auto [it, isNew] = ids.try_emplace(g, static_cast<uint32_t>(shape.positions.size()));
        if (isNew) {
            glm::vec3 p;
            for (int k = 0; k < 3; ++k) {
                p[k] = g[k] == n ? high[k]
                                 : low[k] + (high[k] - low[k]) * (static_cast<float>(g[k]) / n);
            }
            shape.positions.push_back(p);
        }
        return it->second;
    };
    for (int axis = 0; axis < 3; ++axis) {
        for (const int side : {0, n}) {
            for (int u = 0; u < n; ++u) {
                for (int v = 0; v < n; ++v) {
                    const auto at = [&](int du, int dv) {
                        std::array<int, 3> g{};
                        g[axis] = side;
                        g[(axis + 1) % 3] = u + du;
                        g[(axis + 2) % 3] = v + dv;
                        return vertex(g);
                    };
                    uint32_t a = at(0, 0), b = at(1, 0), c = at(1, 1), d = at(0, 1);
                    if (side == 0) std::swap(b, d);
                    shape.triangles.push_back({a, b, c});
                    shape.triangles.push_back({a, c, d});
                }
            }
        }
    }
    return shape;
}

/// A box blown up to a sphere (or ellipsoid).
inline Shape sphere(const glm::vec3& centre, const glm::vec3& radii, int n) {
    Shape shape = box(glm::vec3(-1), glm::vec3(1), n);
    shape.transform([&](glm::vec3 p) {
        for (int k = 0; k < 3; ++k) p[k] = std::tan(p[k] * std::numbers::pi_v<float> / 4);
        const float length = std::sqrt(p.x * p.x + p.y * p.y + p.z * p.z);
        return centre + radii * (p / length);
    });
    return shape;
}

/// A regular icosahedron, each edge halved `steps` times, on a sphere: even sampling.
inline Shape icosphere(const glm::vec3& centre, float radius, int steps) {
    Shape shape;
    const float g = std::numbers::phi_v<float>;
    shape.positions = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                       {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
    shape.triangles = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                       {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                       {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                       {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
    for (int step = 0; step < steps; ++step) {
        std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles;
        const auto middle = [&](uint32_t a, uint32_t b) {
            const auto next = static_cast<uint32_t>(shape.positions.size());
            const auto [it, isNew] = middles.try_emplace(std::minmax(a, b), next);
            if (isNew) shape.positions.push_back((shape.positions[a] + shape.positions[b]) / 2.0F);
            return it->second;
        };
        std::vector<std::array<uint32_t, 3>> halved;
        for (const auto& [a, b, c] : shape.triangles) {
            const uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
            halved.push_back({a, ab, ca});
            halved.push_back({b, bc, ab});
            halved.push_back({c, ca, bc});
            halved.push_back({ab, bc, ca});
        }
        shape.triangles = halved;
        for (glm::vec3& p : shape.positions) {
            p *= std::sqrt((1 + g * g) / (p.x * p.x + p.y * p.y + p.z * p.z));
        }
    }
    shape.transform([&](glm::vec3 p) { return centre + p * (radius / std::sqrt(1 + g * g)); });
    return shape;
}

/// A torus around z.
inline Shape torusShape(float major, float minor, uint32_t around, uint32_t across) {
    Shape shape;
    for (uint32_t i = 0; i < around; ++i) {
        for (uint32_t j = 0; j < across; ++j) {
            const double u = 2 * std::numbers::pi * i / around,
                         v = 2 * std::numbers::pi * j / across;
            const double r = major + minor * std::cos(v);
            shape.positions.emplace_back(r * std::cos(u), r * std::sin(u), minor * std::sin(v));
            const uint32_t i2 = (i + 1) % around, j2 = (j + 1) % across;
            const uint32_t a = i * across + j, b = i2 * across + j, c = i2 * across + j2,
                           d = i * across + j2;
            shape.triangles.push_back({a, b, c});
            shape.triangles.push_back({a, c, d});
        }
    }
    return shape;
}

/// A cylinder along z with round ends, centred in the origin.
inline Shape capsule(float radius, float halfLength, int n) {
    Shape shape = sphere(glm::vec3(0), glm::vec3(radius), n);
    Shape stretched = shape;
    // Spread the sphere's rings along the cylinder so that its sides are sampled too.
    stretched.transform([&](glm::vec3 p) {
        const float t = p.z / radius;
        if (std::abs(t) < 0.7F) {
            const float across = std::sqrt(p.x * p.x + p.y * p.y);
            return glm::vec3(p.x / across * radius, p.y / across * radius, t / 0.7F * halfLength);
        }
        const float side = t < 0 ? -1.0F : 1.0F;
        const float polar = (1 - std::abs(t)) / 0.3F;  // 0 at the pole, 1 at the rim
        const float angle = polar * std::numbers::pi_v<float> / 2;
        const float across = std::max(std::sqrt(p.x * p.x + p.y * p.y), 1e-20F);
        return glm::vec3(p.x / across * radius * std::sin(angle),
                         p.y / across * radius * std::sin(angle),
                         side * (halfLength + radius * std::cos(angle)));
    });
    return stretched;
}

}  // namespace sherd::test
