// SPDX-License-Identifier: MIT
// The page as a coarse grid: which cells do charts cover, and how many of them does a box hold, by
// sums over all cells above and to the left (Crow, Summed-Area Tables, 1984).
#include "layout/free_place.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <tuple>
#include <vector>

#include "layout/drawn_triangle.h"

namespace sherd {

namespace {

constexpr int kCells = 64;

class PageCover {
  public:
    void add(const std::array<glm::vec2, 3>& triangle) {
        std::array<glm::dvec2, 3> p{};
        for (size_t k = 0; k < 3; ++k) p[k] = glm::dvec2(triangle[k]) * double{kCells};
        const auto [left, right] = range(p[0].x, p[1].x, p[2].x);
        const auto [top, bottom] = range(p[0].y, p[1].y, p[2].y);
        const bool small = right - left <= 1 && bottom - top <= 1;
        for (int y = top; y <= bottom; ++y)
            for (int x = left; x <= right; ++x)
                if (small || holds(p, {x + 0.5, y + 0.5})) sums_[index(x + 1, y + 1)] = 1;
    }
    void sum() {
        for (int y = 1; y <= kCells; ++y)
            for (int x = 1; x <= kCells; ++x)
                sums_[index(x, y)] +=
                    sums_[index(x - 1, y)] + sums_[index(x, y - 1)] - sums_[index(x - 1, y - 1)];
    }
    int covered(int x, int y, int width, int height) const {
        return sums_[index(x + width, y + height)] - sums_[index(x, y + height)] -
               sums_[index(x + width, y)] + sums_[index(x, y)];
    }

  private:
    static size_t index(int x, int y) {
        return static_cast<size_t>(y) * (kCells + 1) + static_cast<size_t>(x);
    }

    /// The cells of the page between numbers that may lie anywhere; none for no numbers.
    static std::pair<int, int> range(double a, double b, double c) {
        const auto [low, high] = std::minmax({a, b, c});
        if (!(high >= 0 && low <= kCells)) return {0, -1};
        return {static_cast<int>(std::clamp(low, 0.0, kCells - 1.0)),
                static_cast<int>(std::clamp(high, 0.0, kCells - 1.0))};
    }

    static bool holds(const std::array<glm::dvec2, 3>& p, const glm::dvec2& at) {
        bool left = false;
        bool right = false;
        for (size_t k = 0; k < 3; ++k) {
            const glm::dvec2 along = p[(k + 1) % 3] - p[k];
            const double side = along.x * (at.y - p[k].y) - along.y * (at.x - p[k].x);
            left = left || side < 0;
            right = right || side > 0;
        }
        return !(left && right);
    }

    std::vector<int> sums_ = std::vector<int>(size_t{kCells + 1} * (kCells + 1), 0);
};

}  // namespace

glm::dvec2 freePlace(std::span<const SurfaceMesh> meshes, const glm::dvec2& extent) {
    PageCover cover;
    for (const SurfaceMesh& mesh : meshes) {
        const DrawnMesh drawn(mesh);
        for (size_t t = 0; t < drawn.size(); ++t) cover.add(drawn[t].points);
    }
    cover.sum();
    const glm::ivec2 size =
        glm::ivec2(glm::clamp(glm::ceil(extent * double{kCells}), 1.0, double{kCells}));
    const glm::ivec2 last = glm::ivec2(kCells) - size;
    std::tuple<int, int, int, int> best{kCells * kCells + 1, 0, 0, 0};
    for (int y = 0; y <= last.y; ++y)
        for (int x = 0; x <= last.x; ++x)
            best = std::min(best, {cover.covered(x, y, size.x, size.y),
                                   std::min(x, last.x - x) + std::min(y, last.y - y), y, x});
    return glm::dvec2(std::get<3>(best), std::get<2>(best)) / double{kCells};
}

}  // namespace sherd
