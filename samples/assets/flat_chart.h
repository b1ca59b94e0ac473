// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <utility>
#include <vector>

namespace sherd::samples {

using FlatTriangle = std::array<glm::dvec2, 3>;

inline constexpr uint32_t kViews = 6;  ///< from front, back, right, left, above, below

/// The way towards the viewer.
glm::dvec3 viewDirection(uint32_t view);

/// The place as seen, metres: x to the right, y down.
glm::dvec2 seen(uint32_t view, const glm::dvec3& p);

/// Triangles side by side in the plane.
class FlatChart {
  public:
    explicit FlatChart(double cellSize) : cellSize_(cellSize) {}

    /// Touching is allowed, up to rounding.
    [[nodiscard]] bool overlaps(const FlatTriangle& triangle) const;
    void add(const FlatTriangle& triangle);

  private:
    using CellKey = std::pair<int32_t, int32_t>;
    [[nodiscard]] std::vector<CellKey> cellsOf(const FlatTriangle& triangle) const;

    double cellSize_;
    std::vector<FlatTriangle> triangles_;
    std::map<CellKey, std::vector<uint32_t>> cells_;
};

/// Places boxes of these sizes side by side in the unit square, the same factor applied to all;
/// corners are written to `corners`. Returns the factor.
double packBoxes(const std::vector<glm::dvec2>& sizes, double gutter,
                 std::vector<glm::dvec2>& corners);

}  // namespace sherd::samples
