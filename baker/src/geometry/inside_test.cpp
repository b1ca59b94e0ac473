// SPDX-License-Identifier: MIT
// Signed crossings of an axis-parallel ray.
#include "geometry/inside_test.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include "geometry/parallel_for.h"
#include "geometry/ray_crossing.h"

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

glm::vec3 rotated(const glm::vec3& p, int axis) {
    return {p[(axis + 1) % 3], p[(axis + 2) % 3], p[axis]};
}

}  // namespace

InsideTest::Grid::Grid(std::span<const glm::vec3> positions,
                       std::span<const std::array<uint32_t, 3>> triangles, int axis)
    : axis_(axis) {
    triangles_.reserve(triangles.size());
    for (const auto& t : triangles) {
        triangles_.push_back({{rotated(positions[t[0]], axis), rotated(positions[t[1]], axis),
                               rotated(positions[t[2]], axis)}});
    }
    if (triangles_.empty()) return;
    low_ = high_ = triangles_[0].corners[0];
    for (const Triangle& t : triangles_) {
        for (const glm::vec3& p : t.corners) {
            low_ = {std::min(low_.x, p.x), std::min(low_.y, p.y), std::min(low_.z, p.z)};
            high_ = {std::max(high_.x, p.x), std::max(high_.y, p.y), std::max(high_.z, p.z)};
        }
    }
    chooseResolution();
    sort();
    fill();
}

/// By their first cell: what a ray asks for together lies together.
void InsideTest::Grid::sort() {
    const auto first = [this](const Triangle& t) {
        const Box box = cellsOf(t);
        return static_cast<size_t>(box.y0) * width_ + box.x0;
    };
    std::vector<uint32_t> next(static_cast<size_t>(width_) * height_ + 1, 0);
    for (const Triangle& t : triangles_) ++next[first(t) + 1];
    std::partial_sum(next.begin(), next.end(), next.begin());
    std::vector<Triangle> sorted(triangles_.size());
    for (const Triangle& t : triangles_) sorted[next[first(t)]++] = t;
    triangles_ = std::move(sorted);
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
    const auto& [a, b, c] = t.corners;
    return {cellX(std::min({a.x, b.x, c.x})), cellX(std::max({a.x, b.x, c.x})),
            cellY(std::min({a.y, b.y, c.y})), cellY(std::max({a.y, b.y, c.y}))};
}

/// About two cells per triangle, fewer while long triangles would fill more than 8 cells on
/// average.
void InsideTest::Grid::chooseResolution() {
    const glm::dvec2 extent(static_cast<double>(high_.x) - low_.x,
                            static_cast<double>(high_.y) - low_.y);
    const double longer = std::max(extent.x, extent.y);
    if (!(longer > 0)) return;
    const double cells = 2.0 * static_cast<double>(triangles_.size());
    const double area = std::max(extent.x / longer, 1e-6) * std::max(extent.y / longer, 1e-6);
    for (double perSide = std::sqrt(cells / area);; perSide /= 1.25) {
        const auto count = [&](double e) {
            return static_cast<uint32_t>(std::clamp(perSide * e / longer, 1.0, 16384.0));
        };
        width_ = count(extent.x);
        height_ = count(extent.y);
        cellsPerUnit_ = {extent.x > 0 ? width_ / extent.x : 0,
                         extent.y > 0 ? height_ / extent.y : 0};
        uint64_t entries = 0;
        for (const Triangle& t : triangles_) {
            const Box box = cellsOf(t);
            entries += static_cast<uint64_t>(box.x1 - box.x0 + 1) * (box.y1 - box.y0 + 1);
        }
        if (entries <= 12 * triangles_.size() || (width_ == 1 && height_ == 1)) return;
    }
}

void InsideTest::Grid::fill() {
    cellStart_.assign(static_cast<size_t>(width_) * height_ + 1, 0);
    const auto forEachCell = [&](const Triangle& t, const auto& visit) {
        const Box box = cellsOf(t);
        for (uint32_t y = box.y0; y <= box.y1; ++y) {
            for (uint32_t x = box.x0; x <= box.x1; ++x) visit(static_cast<size_t>(y) * width_ + x);
        }
    };
    for (const Triangle& t : triangles_) {
        forEachCell(t, [&](size_t cell) { ++cellStart_[cell + 1]; });
    }
    for (size_t i = 1; i < cellStart_.size(); ++i) cellStart_[i] += cellStart_[i - 1];
    cellTriangles_.resize(cellStart_.back());
    std::vector<uint32_t> next(cellStart_.begin(), cellStart_.end() - 1);
    for (uint32_t i = 0; i < triangles_.size(); ++i) {
        forEachCell(triangles_[i], [&](size_t cell) { cellTriangles_[next[cell]++] = i; });
    }
}

InsideTest::Crossings InsideTest::Grid::crossings(const glm::dvec3& point, bool bothWays) const {
    const glm::dvec3 q(point[(axis_ + 1) % 3], point[(axis_ + 2) % 3], point[axis_]);
    Crossings result;
    const bool inRange = q.x >= low_.x && q.x <= high_.x && q.y >= low_.y && q.y <= high_.y;
    if (!inRange || triangles_.empty()) return result;  // also refuses NaN
    const size_t cell = static_cast<size_t>(cellY(q.y)) * width_ + cellX(q.x);
    for (uint32_t i = cellStart_[cell]; i < cellStart_[cell + 1]; ++i) {
        const Triangle& t = triangles_[cellTriangles_[i]];
        const auto& [a, b, c] = t.corners;
        if (!bothWays && a.z < q.z && b.z < q.z && c.z < q.z) continue;
        const int turn = lineCrossing(t.corners, q);
        if (turn == 0) continue;
        if (liesAbove(t.corners, q, turn)) {
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
