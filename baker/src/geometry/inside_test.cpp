// SPDX-License-Identifier: MIT
// Signed crossings of an axis-parallel ray.
#include "geometry/inside_test.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <numeric>

#include "geometry/four.h"
#include "geometry/ray_crossing.h"
#include "parallel/parallel_for.h"

namespace sherd {
namespace {

uint64_t mix(uint64_t x) {  // the finaliser of SplitMix64
    x ^= x >> 30;
    x *= 0xbf58476d1ce4e5b9ULL;
    x ^= x >> 27;
    x *= 0x94d049bb133111ebULL;
    return x ^ (x >> 31);
}

uint64_t hashPosition(const glm::vec3& p) {
    // + 0.0F makes -0 and 0 one value.
    uint64_t h = 0x9e3779b97f4a7c15ULL;
    for (const float x : {p.x, p.y, p.z}) h = mix(h + std::bit_cast<uint32_t>(x + 0.0F));
    return h;
}

/// Whether the directed edges cancel. Each adds a 64-bit hash of its two ends, its reverse
/// subtracts the same: the sum is 0 for a closed surface and for an open one only with a chance of
/// 2^-64. (Sorting the edges says the same in ten times the time.)
bool edgesCancel(std::span<const glm::vec3> positions,
                 std::span<const std::array<uint32_t, 3>> triangles) {
    std::vector<uint64_t> hashes(positions.size());
    std::transform(positions.begin(), positions.end(), hashes.begin(), hashPosition);
    uint64_t sum = 0;
    for (const auto& t : triangles) {
        for (int k = 0; k < 3; ++k) {
            const uint64_t a = hashes[t[k]], b = hashes[t[(k + 1) % 3]];
            if (a < b) sum += mix(a ^ std::rotl(b, 17));
            if (b < a) sum -= mix(b ^ std::rotl(a, 17));
        }
    }
    return sum == 0;
}

Lanes rotated(const glm::vec3& p, int axis) {
    return {{p[(axis + 1) % 3], p[(axis + 2) % 3], p[axis], 0}};
}

glm::vec3 pointOf(const Lanes& corner) {
    return {corner.at[0], corner.at[1], corner.at[2]};
}

float least(const std::array<Lanes, 3>& corners, size_t axis) {
    return std::min(std::min(corners[0].at[axis], corners[1].at[axis]), corners[2].at[axis]);
}
float most(const std::array<Lanes, 3>& corners, size_t axis) {
    return std::max(std::max(corners[0].at[axis], corners[1].at[axis]), corners[2].at[axis]);
}

/// The largest float that is not above, and the smallest not below.
float below(double x) {
    const auto f = static_cast<float>(x);
    return f > x ? std::nextafter(f, -INFINITY) : f;
}
float above(double x) {
    return -below(-x);
}

}  // namespace

InsideTest::Grid::Grid(std::span<const glm::vec3> positions,
                       std::span<const std::array<uint32_t, 3>> triangles, int axis)
    : axis_(axis) {
    triangles_.reserve(triangles.size());
    for (const auto& t : triangles) {
        triangles_.push_back({rotated(positions[t[0]], axis), rotated(positions[t[1]], axis),
                              rotated(positions[t[2]], axis)});
    }
    if (triangles_.empty()) return;
    low_ = high_ = pointOf(triangles_[0][0]);
    for (const Triangle& t : triangles_) {
        for (const Lanes& corner : t) {
            low_ = glm::min(low_, pointOf(corner));
            high_ = glm::max(high_, pointOf(corner));
        }
    }
    chooseResolution();
    fill();
}

uint32_t InsideTest::Grid::cellX(double x) const {
    const double cell = (x - low_.x) * cellsPerUnit_.x;
    return static_cast<uint32_t>(std::clamp(cell, 0.0, width_ - 1.0));
}

uint32_t InsideTest::Grid::cellY(double y) const {
    const double cell = (y - low_.y) * cellsPerUnit_.y;
    return static_cast<uint32_t>(std::clamp(cell, 0.0, height_ - 1.0));
}

InsideTest::Grid::Box InsideTest::Grid::cellsOf(const Triangle& t) const {
    return {cellX(least(t, 0)), cellX(most(t, 0)), cellY(least(t, 1)), cellY(most(t, 1))};
}

/// About two cells per triangle, fewer if then the triangles would fill more than 12 cells each.
void InsideTest::Grid::chooseResolution() {
    constexpr double kCells = 2, kFilled = 8;
    const glm::dvec2 extent(static_cast<double>(high_.x) - low_.x,
                            static_cast<double>(high_.y) - low_.y);
    const double longer = std::max(extent.x, extent.y);
    if (!(longer > 0)) return;
    const auto count = static_cast<double>(triangles_.size());
    const double area = std::max(extent.x / longer, 1e-6) * std::max(extent.y / longer, 1e-6);
    // A box of w by h cells lies in (w + 1) (h + 1) of them on average: of perSide, a square.
    double squares = 0, sides = 0;
    for (const Triangle& t : triangles_) {
        const double w = (double{most(t, 0)} - least(t, 0)) / longer;
        const double h = (double{most(t, 1)} - least(t, 1)) / longer;
        squares += w * h;
        sides += w + h;
    }
    const double more = (kFilled - 1) * count;
    const double finest = 2 * more / (sides + std::sqrt(sides * sides + 4 * squares * more));
    const double perSide = std::min(std::sqrt(kCells * count / area), finest);
    const auto cells = [&](double e) {
        return static_cast<uint32_t>(std::clamp(perSide * e / longer, 1.0, 16384.0));
    };
    width_ = cells(extent.x);
    height_ = cells(extent.y);
    cellsPerUnit_ = {extent.x > 0 ? width_ / extent.x : 0, extent.y > 0 ? height_ / extent.y : 0};
}

/// Sorts the triangles by their first cell: what a ray asks for together lies together.
void InsideTest::Grid::fill() {
    const size_t cells = static_cast<size_t>(width_) * height_;
    std::vector<Box> boxes;
    boxes.reserve(triangles_.size());
    for (const Triangle& t : triangles_) boxes.push_back(cellsOf(t));
    const auto cellAt = [this](uint32_t x, uint32_t y) { return size_t{y} * width_ + x; };
    std::vector<uint32_t> next(cells + 1, 0), order(triangles_.size());
    for (const Box& box : boxes) ++next[cellAt(box.x0, box.y0) + 1];
    std::partial_sum(next.begin(), next.end(), next.begin());
    for (uint32_t i = 0; i < order.size(); ++i) order[next[cellAt(boxes[i].x0, boxes[i].y0)]++] = i;
    const auto forEachCell = [&](const auto& visit) {
        for (uint32_t i = 0; i < order.size(); ++i) {
            const Box& box = boxes[order[i]];
            for (uint32_t y = box.y0; y <= box.y1; ++y)
                for (uint32_t x = box.x0; x <= box.x1; ++x) visit(i, cellAt(x, y));
        }
    };
    cellStart_.assign(cells + 1, 0);
    forEachCell([&](uint32_t, size_t cell) { ++cellStart_[cell + 1]; });
    std::partial_sum(cellStart_.begin(), cellStart_.end(), cellStart_.begin());
    cellTriangles_.resize(cellStart_.back());
    next.assign(cellStart_.begin(), cellStart_.end() - 1);
    forEachCell([&](uint32_t i, size_t cell) { cellTriangles_[next[cell]++] = i; });
    std::vector<Triangle> sorted;
    sorted.reserve(triangles_.size());
    for (const uint32_t i : order) sorted.push_back(triangles_[i]);
    triangles_ = std::move(sorted);
}

InsideTest::Crossings InsideTest::Grid::crossings(const glm::dvec3& point, bool bothWays) const {
    const glm::dvec3 q(point[(axis_ + 1) % 3], point[(axis_ + 2) % 3], point[axis_]);
    Crossings result;
    const bool inRange = q.x >= low_.x && q.x <= high_.x && q.y >= low_.y && q.y <= high_.y;
    if (!inRange || triangles_.empty()) return result;  // also refuses NaN
    const Lanes low{{below(q.x), below(q.y), bothWays ? -INFINITY : below(q.z), 0}};
    const Lanes high{{above(q.x), above(q.y), INFINITY, 0}};
    const size_t cell = static_cast<size_t>(cellY(q.y)) * width_ + cellX(q.x);
    for (uint32_t i = cellStart_[cell]; i < cellStart_[cell + 1]; ++i) {
        const Triangle& t = triangles_[cellTriangles_[i]];
        const Four a = loaded(t[0]), b = loaded(t[1]), c = loaded(t[2]);
        if (xsimd::any((xsimd::max(xsimd::max(a, b), c) < loaded(low)) |
                       (xsimd::min(xsimd::min(a, b), c) > loaded(high))))
            continue;
        const std::array<glm::vec3, 3> corners{pointOf(t[0]), pointOf(t[1]), pointOf(t[2])};
        const int turn = lineCrossing(corners, q);
        if (turn == 0) continue;
        if (liesAbove(corners, q, turn)) {
            result.up += turn;
        } else {
            result.down -= turn;
        }
    }
    return result;
}

InsideTest::InsideTest(std::span<const glm::vec3> positions,
                       std::span<const std::array<uint32_t, 3>> triangles) {
    if (!edgesCancel(positions, triangles)) {
        for (int axis = 0; axis < 3; ++axis) grids_.emplace_back(positions, triangles, axis);
        return;
    }
    // Rays along the shortest side of the bounding box cross the fewest triangles.
    glm::dvec3 low(INFINITY), high(-INFINITY);
    for (const auto& t : triangles) {
        for (const uint32_t v : t) {
            low = glm::dvec3(std::min<double>(low.x, positions[v].x),
                             std::min<double>(low.y, positions[v].y),
                             std::min<double>(low.z, positions[v].z));
            high = glm::dvec3(std::max<double>(high.x, positions[v].x),
                              std::max<double>(high.y, positions[v].y),
                              std::max<double>(high.z, positions[v].z));
        }
    }
    int axis = 2;
    for (int k = 0; k < 2; ++k) {
        if (high[k] - low[k] < high[axis] - low[axis]) axis = k;
    }
    grids_.emplace_back(positions, triangles, axis);
}

int InsideTest::winding(const glm::dvec3& point) const {
    if (closed()) return grids_[0].crossings(point, false).up;
    std::array<int, 6> counts{};
    for (size_t axis = 0; axis < 3; ++axis) {
        const Crossings crossings = grids_[axis].crossings(point, true);
        counts[2 * axis] = crossings.up;
        counts[2 * axis + 1] = crossings.down;
    }
    std::sort(counts.begin(), counts.end());
    return counts[2];
}

void InsideTest::inside(std::span<const glm::vec3> points, std::span<uint8_t> result,
                        unsigned threads) const {
    constexpr size_t kGrain = 512;
    parallelRuns(points.size(), kGrain, threads, [&](size_t first, size_t last) {
        for (size_t i = first; i < last; ++i) result[i] = inside(glm::dvec3(points[i])) ? 1 : 0;
    });
}

}  // namespace sherd
