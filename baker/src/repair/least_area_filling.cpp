// SPDX-License-Identifier: MIT
// G. Barequet and M. Sharir, "Filling Gaps in the Boundary of a Polyhedron" (1995): the best
// filling of a run of corners is the best triangle on its ends with the best fillings of the two
// runs it leaves.
#include "repair/least_area_filling.h"

#include <glm/geometric.hpp>
#include <limits>

namespace sherd {
namespace {

constexpr double kImpossible = std::numeric_limits<double>::infinity();

class LeastArea {
  public:
    LeastArea(std::span<const glm::vec3> polygon,
              const std::function<bool(uint32_t, uint32_t)>& forbidden)
        : polygon_(polygon), count_(polygon.size()) {
        area_.assign(count_ * count_, 0);
        apex_.assign(count_ * count_, 0);
        for (size_t length = 2; length < count_; ++length) {
            for (size_t i = 0; i + length < count_; ++i) {
                const auto a = static_cast<uint32_t>(i), b = static_cast<uint32_t>(i + length);
                const bool border = length + 1 == count_;
                if (!border && forbidden && forbidden(a, b))
                    area_[a * count_ + b] = kImpossible;
                else
                    choose(a, b);
            }
        }
    }

    std::vector<std::array<uint32_t, 3>> triangles() const {
        std::vector<std::array<uint32_t, 3>> result;
        const auto last = static_cast<uint32_t>(count_ - 1);
        if (area_[last] == kImpossible) return result;
        std::vector<std::array<uint32_t, 2>> runs = {{0, last}};
        while (!runs.empty()) {
            const auto [a, b] = runs.back();
            runs.pop_back();
            if (b - a < 2) continue;
            const uint32_t m = apex_[a * count_ + b];
            result.push_back({a, m, b});
            runs.push_back({a, m});
            runs.push_back({m, b});
        }
        return result;
    }

  private:
    void choose(uint32_t a, uint32_t b) {
        double best = kImpossible;
        for (uint32_t m = a + 1; m < b; ++m) {
            const double rest = area_[a * count_ + m] + area_[m * count_ + b];
            if (!(rest < best)) continue;
            const glm::dvec3 p(polygon_[a]);
            const double own = 0.5 * glm::length(glm::cross(glm::dvec3(polygon_[m]) - p,
                                                            glm::dvec3(polygon_[b]) - p));
            if (!(own > 0) || !(rest + own < best)) continue;
            best = rest + own;
            apex_[a * count_ + b] = m;
        }
        area_[a * count_ + b] = best;
    }

    std::span<const glm::vec3> polygon_;
    size_t count_;
    std::vector<double> area_;    ///< of the filling of corners a..b, at a * count + b
    std::vector<uint32_t> apex_;  ///< of its triangle on a and b
};

}  // namespace

std::vector<std::array<uint32_t, 3>> fillWithLeastArea(
    std::span<const glm::vec3> polygon, const std::function<bool(uint32_t, uint32_t)>& forbidden) {
    if (polygon.size() < 3 || polygon.size() > kMostCornersOfLeastArea) return {};
    return LeastArea(polygon, forbidden).triangles();
}

}  // namespace sherd
