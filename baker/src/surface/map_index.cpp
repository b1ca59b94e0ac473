// SPDX-License-Identifier: MIT
#include "surface/map_index.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/vec2.hpp>

namespace sherd {
namespace {

/// A grid box that surely holds the node: a crossing's double position is good to far less than a
/// unit.
void extend(const PlanarMap& map, uint32_t node, GridPoint& low, GridPoint& high) {
    const glm::dvec2 p = nodeUv(map, node) * double{kGridOne};
    low.u = std::min(low.u, static_cast<int32_t>(std::floor(p.x)) - 1);
    low.v = std::min(low.v, static_cast<int32_t>(std::floor(p.y)) - 1);
    high.u = std::max(high.u, static_cast<int32_t>(std::ceil(p.x)) + 1);
    high.v = std::max(high.v, static_cast<int32_t>(std::ceil(p.y)) + 1);
}

}  // namespace

MapIndex::MapIndex(const PlanarMap& map) {
    constexpr int32_t kMax = 1 << 30;
    GridPoint low{kMax, kMax};
    GridPoint high{-kMax, -kMax};
    boxes_.reserve(map.edges.size());
    for (const MapEdge& edge : map.edges) {
        Box box{{kMax, kMax}, {-kMax, -kMax}};
        extend(map, edge.from, box.low, box.high);
        extend(map, edge.to, box.low, box.high);
        low = {std::min(low.u, box.low.u), std::min(low.v, box.low.v)};
        high = {std::max(high.u, box.high.u), std::max(high.v, box.high.v)};
        boxes_.push_back(box);
    }
    if (boxes_.empty()) {
        start_.assign(2, 0);
        return;
    }
    // One to four cells an edge keep both the cells and the edges a triangle meets few.
    const auto side = static_cast<uint32_t>(
        std::clamp(std::sqrt(static_cast<double>(boxes_.size())) * 2, 1.0, 1024.0));
    const int64_t extent = std::max(int64_t{high.u} - low.u, int64_t{high.v} - low.v) + 1;
    origin_ = low;
    shift_ = static_cast<uint32_t>(std::bit_width(static_cast<uint64_t>(extent / side)));
    columns_ = static_cast<uint32_t>(((int64_t{high.u} - low.u) >> shift_) + 1);
    rows_ = static_cast<uint32_t>(((int64_t{high.v} - low.v) >> shift_) + 1);

    start_.assign(size_t{columns_} * rows_ + 1, 0);
    for (uint32_t e = 0; e < boxes_.size(); ++e)
        forEachCell(map, e, [this](uint32_t cell) { ++start_[cell + 1]; });
    for (size_t i = 1; i < start_.size(); ++i) start_[i] += start_[i - 1];
    edges_.resize(start_.back());
    std::vector<uint32_t> next(start_.begin(), start_.end() - 1);
    for (uint32_t e = 0; e < boxes_.size(); ++e)
        forEachCell(map, e, [&](uint32_t cell) { edges_[next[cell]++] = e; });
    found_.assign(boxes_.size(), 0);
}

/// The cells an edge passes through, row by row, and perhaps some beside them. Cells of its whole
/// box would be the square of that for a long slanting edge.
template <class Visit>
void MapIndex::forEachCell(const PlanarMap& map, uint32_t edge, Visit&& visit) const {
    const Box& box = boxes_[edge];
    const uint32_t firstRow = row(box.low.v), lastRow = row(box.high.v);
    const glm::dvec2 a = nodeUv(map, map.edges[edge].from) * double{kGridOne};
    const glm::dvec2 b = nodeUv(map, map.edges[edge].to) * double{kGridOne};
    for (uint32_t r = firstRow; r <= lastRow; ++r) {
        int64_t from = box.low.u;
        int64_t to = box.high.u;
        if (firstRow != lastRow && a.y != b.y) {
            // Where it enters and leaves the row. A unit more above and below, and two aside, is
            // wider than the nodes' rounding can be off.
            const double slope = (b.x - a.x) / (b.y - a.y);
            const double bottom = static_cast<double>(origin_.v + (int64_t{r} << shift_)) - 1;
            const double top = bottom + static_cast<double>(int64_t{1} << shift_) + 2;
            const auto [low, high] =
                std::minmax({a.x + (bottom - a.y) * slope, a.x + (top - a.y) * slope});
            from = std::max(from, static_cast<int64_t>(std::floor(std::max(low, -1e10))) - 2);
            to = std::min(to, static_cast<int64_t>(std::ceil(std::min(high, 1e10))) + 2);
        }
        for (uint32_t c = column(from); c <= column(to); ++c) visit(r * columns_ + c);
    }
}

uint32_t MapIndex::column(int64_t u) const {
    return static_cast<uint32_t>(std::clamp<int64_t>((u - origin_.u) >> shift_, 0, columns_ - 1));
}
uint32_t MapIndex::row(int64_t v) const {
    return static_cast<uint32_t>(std::clamp<int64_t>((v - origin_.v) >> shift_, 0, rows_ - 1));
}

void MapIndex::query(GridPoint low, GridPoint high, std::vector<uint32_t>& result) {
    result.clear();
    if (boxes_.empty()) return;
    ++query_;
    const uint32_t firstColumn = column(low.u), lastColumn = column(high.u);
    const uint32_t lastRow = row(high.v);
    for (uint32_t r = row(low.v); r <= lastRow; ++r) {
        for (uint32_t c = firstColumn; c <= lastColumn; ++c) {
            for (uint32_t i = start_[r * columns_ + c]; i < start_[r * columns_ + c + 1]; ++i) {
                const Box& box = boxes_[edges_[i]];
                if (found_[edges_[i]] == query_) continue;
                if (box.high.u < low.u || box.low.u > high.u || box.high.v < low.v ||
                    box.low.v > high.v) {
                    continue;
                }
                found_[edges_[i]] = query_;
                result.push_back(edges_[i]);
            }
        }
    }
    if (result.size() > 1) std::sort(result.begin(), result.end());
}

}  // namespace sherd
