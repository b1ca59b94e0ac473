// SPDX-License-Identifier: MIT
// Spanning a closed polygon in space with triangles between its own corners.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

namespace sherd {

struct PolygonCorner {
    glm::dvec3 position{0.0};
    glm::dvec3 inwards{0.0};  ///< unit, into the solid; zero: no preference
    uint32_t side = 0;        ///< which of the lines around the polygon it lies on
};

/// Which triangles are dear.
enum class FillingStyle : uint8_t {
    even,   ///< those that lie in the surface: triangles are as regular as may be
    steep,  ///< those that lean towards the surface
    ruled   ///< those with all corners on one side: rungs lead from side to side
};

/// Triangles over the corners' indices, turning the polygon's way; nothing if all triangulations
/// need an edge that `allowed(i, j)`, i < j, refuses. The polygon's own edges are not asked for.
std::optional<std::vector<std::array<uint32_t, 3>>> fillPolygon(
    std::span<const PolygonCorner> corners, FillingStyle style,
    const std::function<bool(uint32_t, uint32_t)>& allowed);

}  // namespace sherd
