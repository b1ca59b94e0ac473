// SPDX-License-Identifier: MIT
#include "flat_chart.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numeric>

namespace sherd::samples {
namespace {

struct View {
    glm::dvec3 towards, right, down;
};

constexpr std::array<View, kViews> kViewAxes{{{{0, 0, 1}, {1, 0, 0}, {0, -1, 0}},
                                              {{0, 0, -1}, {-1, 0, 0}, {0, -1, 0}},
                                              {{1, 0, 0}, {0, 0, -1}, {0, -1, 0}},
                                              {{-1, 0, 0}, {0, 0, 1}, {0, -1, 0}},
                                              {{0, 1, 0}, {1, 0, 0}, {0, 0, 1}},
                                              {{0, -1, 0}, {1, 0, 0}, {0, 0, -1}}}};

/// Is there an edge of `a` that has all of `b` on its outer side?
bool separates(const FlatTriangle& a, const FlatTriangle& b) {
    constexpr double kRounding = 1e-7;  // metres
    for (size_t k = 0; k < 3; ++k) {
        const glm::dvec2 along = a[(k + 1) % 3] - a[k];
        const double length = glm::length(along);
        if (length == 0) continue;
        glm::dvec2 out = glm::dvec2(along.y, -along.x) / length;
        if (glm::dot(out, a[(k + 2) % 3] - a[k]) > 0) out = -out;
        const auto beyond = [&](const glm::dvec2& p) { return glm::dot(out, p - a[k]); };
        if (std::min({beyond(b[0]), beyond(b[1]), beyond(b[2])}) > -kRounding) return true;
    }
    return false;
}

/// The upper rim of what has been placed, as steps from left to right.
class Skyline {
  public:
    /// Where a box of this size comes to lie lowest, leftmost if in doubt.
    glm::dvec2 place(const glm::dvec2& size) {
        glm::dvec2 best(0, 1e9);
        for (size_t i = 0; i < steps_.size(); ++i) {
            if (steps_[i].x + size.x > 1) break;
            double top = 0;
            for (size_t j = i; j < steps_.size() && steps_[j].x < steps_[i].x + size.x; ++j)
                top = std::max(top, steps_[j].y);
            if (top < best.y) best = {steps_[i].x, top};
        }
        if (best.y < 1e9) raise(best, size);
        return best;
    }

  private:
    void raise(const glm::dvec2& corner, const glm::dvec2& size) {
        const double end = corner.x + size.x;
        double heightAtEnd = 0;
        std::vector<glm::dvec2> steps;
        for (const glm::dvec2& step : steps_) {
            if (step.x <= end) heightAtEnd = step.y;
            if (step.x < corner.x || step.x > end) steps.push_back(step);
        }
        steps.emplace_back(corner.x, corner.y + size.y);
        steps.emplace_back(end, heightAtEnd);
        std::sort(steps.begin(), steps.end(),
                  [](const glm::dvec2& a, const glm::dvec2& b) { return a.x < b.x; });
        steps_ = std::move(steps);
    }

    std::vector<glm::dvec2> steps_{glm::dvec2(0, 0)};
};

/// Tallest first. False when the boxes do not fit at this factor.
bool packAt(double factor, const std::vector<glm::dvec2>& sizes, double gutter,
            std::vector<glm::dvec2>& corners) {
    std::vector<uint32_t> order(sizes.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(),
                     [&](uint32_t a, uint32_t b) { return sizes[a].y > sizes[b].y; });
    Skyline skyline;
    corners.assign(sizes.size(), glm::dvec2(0));
    for (const uint32_t i : order) {
        const glm::dvec2 box = sizes[i] * factor + gutter;
        corners[i] = skyline.place(box + glm::dvec2(gutter, 0));
        if (corners[i].y + box.y + gutter > 1) return false;
        corners[i] += gutter;
    }
    return true;
}

}  // namespace

glm::dvec3 viewDirection(uint32_t view) {
    return kViewAxes[view].towards;
}

glm::dvec2 seen(uint32_t view, const glm::dvec3& p) {
    return {glm::dot(kViewAxes[view].right, p), glm::dot(kViewAxes[view].down, p)};
}

std::vector<FlatChart::CellKey> FlatChart::cellsOf(const FlatTriangle& triangle) const {
    const glm::dvec2 low =
        glm::floor(glm::min(triangle[0], glm::min(triangle[1], triangle[2])) / cellSize_);
    const glm::dvec2 high =
        glm::floor(glm::max(triangle[0], glm::max(triangle[1], triangle[2])) / cellSize_);
    std::vector<CellKey> keys;
    for (auto y = int32_t(low.y); y <= int32_t(high.y); ++y) {
        for (auto x = int32_t(low.x); x <= int32_t(high.x); ++x) keys.emplace_back(x, y);
    }
    return keys;
}

bool FlatChart::overlaps(const FlatTriangle& triangle) const {
    for (const CellKey& key : cellsOf(triangle)) {
        const auto cell = cells_.find(key);
        if (cell == cells_.end()) continue;
        for (const uint32_t other : cell->second) {
            if (!separates(triangle, triangles_[other]) && !separates(triangles_[other], triangle))
                return true;
        }
    }
    return false;
}

void FlatChart::add(const FlatTriangle& triangle) {
    for (const CellKey& key : cellsOf(triangle))
        cells_[key].push_back(static_cast<uint32_t>(triangles_.size()));
    triangles_.push_back(triangle);
}

double packBoxes(const std::vector<glm::dvec2>& sizes, double gutter,
                 std::vector<glm::dvec2>& corners) {
    double fits = 0;
    double tooLarge = 1e3;
    for (uint32_t round = 0; round < 40; ++round) {
        const double factor = (fits + tooLarge) / 2;
        (packAt(factor, sizes, gutter, corners) ? fits : tooLarge) = factor;
    }
    packAt(fits, sizes, gutter, corners);
    return fits;
}

}  // namespace sherd::samples
