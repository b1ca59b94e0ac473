// SPDX-License-Identifier: MIT
#include "volume/triangle_cells.h"

#include <algorithm>

namespace sherd {

std::span<const TriangleCells::Polygon> TriangleCells::run(
    uint32_t triangle, const std::array<uint32_t, 3>& cornerCells) {
    triangle_ = triangle;
    count_ = 0;
    for (const uint32_t cell : cornerCells) reach(cell);
    for (size_t n = 0; n < count_; ++n) {
        Polygon polygon = std::move(polygons_[n]);  // `reach` may move the others
        polygon.sides.assign({{true, 0, {}}, {true, 1, {}}, {true, 2, {}}});
        polygon.coplanar.clear();
        const auto neighbors = complex_.neighbors(polygon.cell);
        const auto bands = complex_.bands(polygon.cell);
        for (size_t k = 0; k < neighbors.size(); ++k) clipBy(neighbors[k], bands[k], polygon);
        polygon.corners.clear();
        for (size_t k = 0; k < polygon.sides.size(); ++k) {
            const Side& side = polygon.sides[k];
            if (!side.edge) reach(side.index);
            polygon.corners.push_back(
                vertexOf(polygon.cell, side, polygon.sides[(k + 1) % polygon.sides.size()]));
        }
        polygons_[n] = std::move(polygon);
    }
    return std::span(polygons_).first(count_);
}

void TriangleCells::reach(uint32_t cell) {
    for (size_t n = 0; n < count_; ++n)
        if (polygons_[n].cell == cell) return;
    if (count_ == polygons_.size()) polygons_.emplace_back();
    polygons_[count_++].cell = cell;
}

void TriangleCells::clipBy(uint32_t l, int64_t band, Polygon& polygon) {
    const CornerValues il = input_.cornerValues(triangle_, polygon.cell, l);
    const auto [lowest, highest] = std::minmax({il[0], il[1], il[2]});
    if (lowest >= -band && highest <= band) polygon.coplanar.push_back(l);
    if (highest < 0) return;
    std::vector<Side>& sides = polygon.sides;
    const size_t n = sides.size();
    kept_.resize(n);
    size_t count = 0;
    for (size_t c = 0; c < n; ++c) {
        kept_[c] = keeps(sides[c], sides[(c + 1) % n], il, polygon.cell, l) ? 1 : 0;
        count += kept_[c];
    }
    if (count == n) return;
    clipped_.clear();
    if (count > 0) {
        // The corners that stay are a run; the side before its first and the one after its last
        // stay too, and the plane closes the gap.
        size_t first = 0;
        while (kept_[first] == 0 || kept_[(first + n - 1) % n] != 0) ++first;
        clipped_.push_back({false, l, il});
        for (size_t k = 0; k <= count; ++k) clipped_.push_back(sides[(first + k) % n]);
    }
    std::swap(sides, clipped_);
}

/// Whether the corner between two sides stays in cell i when l's plane is the next.
bool TriangleCells::keeps(const Side& a, const Side& b, const CornerValues& il, uint32_t i,
                          uint32_t l) const {
    if (a.edge && b.edge) return signAtCorner(il[b.index], i, l) < 0;
    if (!a.edge && !b.edge) {
        return signInTriangle(a.below, b.below, il, i, a.index, b.index, l) < 0;
    }
    const Side& plane = a.edge ? b : a;
    const uint32_t from = a.edge ? a.index : b.index;
    const uint32_t to = (from + 1) % 3;
    return signOnEdge({plane.below[from], plane.below[to]}, {il[from], il[to]}, i, plane.index, l) <
           0;
}

uint32_t TriangleCells::vertexOf(uint32_t cell, const Side& a, const Side& b) {
    const auto& v = input_.triangles[triangle_];
    if (a.edge && b.edge) return v[b.index];
    if (!a.edge && !b.edge) return vertices_.inTriangle(triangle_, cell, a.index, b.index);
    const uint32_t from = a.edge ? a.index : b.index;
    return vertices_.onEdge(v[from], v[(from + 1) % 3], cell, a.edge ? b.index : a.index);
}

}  // namespace sherd
