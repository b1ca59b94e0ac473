// SPDX-License-Identifier: MIT
// Closed meshes whose volumes and inertias are known.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace sherd::test {

struct Shape {
    std::vector<glm::vec3> positions;
    std::vector<std::array<uint32_t, 3>> triangles;
};

inline Shape box(const glm::vec3& low, const glm::vec3& high) {
    Shape out;
    for (uint32_t i = 0; i < 8; ++i) {
        out.positions.emplace_back((i & 1) != 0 ? high.x : low.x, (i & 2) != 0 ? high.y : low.y,
                                   (i & 4) != 0 ? high.z : low.z);
    }
    out.triangles = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}, {0, 1, 5}, {0, 5, 4},
                     {2, 6, 7}, {2, 7, 3}, {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};
    return out;
}

inline Shape tetrahedron() {
    return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
            {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
}

/// Rings of latitude, `n` of them, and twice as many corners each.
inline Shape sphere(uint32_t n, const glm::vec3& center, float radius) {
    Shape out;
    const uint32_t m = 2 * n;
    const double pi = 3.14159265358979323846;
    out.positions.push_back(center + glm::vec3(0, 0, radius));
    for (uint32_t i = 1; i < n; ++i) {
        for (uint32_t j = 0; j < m; ++j) {
            const double a = pi * i / n;
            const double b = 2 * pi * j / m;
            out.positions.push_back(center + radius * glm::vec3(std::sin(a) * std::cos(b),
                                                                std::sin(a) * std::sin(b),
                                                                std::cos(a)));
        }
    }
    out.positions.push_back(center - glm::vec3(0, 0, radius));
    const auto south = static_cast<uint32_t>(out.positions.size()) - 1;
    const auto at = [&](uint32_t i, uint32_t j) { return 1 + (i - 1) * m + j % m; };
    for (uint32_t j = 0; j < m; ++j) {
        out.triangles.push_back({0, at(1, j), at(1, j + 1)});
        for (uint32_t i = 1; i + 1 < n; ++i) {
            out.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
            out.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
        }
        out.triangles.push_back({at(n - 1, j), south, at(n - 1, j + 1)});
    }
    return out;
}

}  // namespace sherd::test
