// SPDX-License-Identifier: MIT
#include "ray_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sherd {

namespace {

constexpr int32_t kGrid = 1 << 29;

/// Side of (pu, pv) against the line a -> b: positive on the left. Below 2^61, so exact.
int64_t side(int64_t au, int64_t av, int64_t bu, int64_t bv, int64_t pu, int64_t pv) {
    return (bu - au) * (pv - av) - (bv - av) * (pu - au);
}

/// The sign that `side` takes when the point moves by (e, e^2).
int signAfterShift(int64_t value, int64_t au, int64_t av, int64_t bu, int64_t bv) {
    if (value != 0) return value > 0 ? 1 : -1;
    if (bv != av) return bv < av ? 1 : -1;
    return bu > au ? 1 : -1;
}

}  // namespace

RayGrid::RayGrid(const std::vector<glm::vec3>& positions,
                 const std::vector<std::array<uint32_t, 3>>& triangles,
                 const std::vector<uint32_t>& labels, int axis)
    : axis_(axis) {
    glm::dvec3 low(std::numeric_limits<double>::max());
    glm::dvec3 high(-std::numeric_limits<double>::max());
    for (const auto& triangle : triangles)
        for (const uint32_t v : triangle)
            for (int a = 0; a < 3; ++a) {
                low[a] = std::min<double>(low[a], positions[v][a]);
                high[a] = std::max<double>(high[a], positions[v][a]);
            }
    low_ = low;
    for (int a = 0; a < 3; ++a) scale_[a] = high[a] > low[a] ? kGrid / (high[a] - low[a]) : 0.0;
    cells_ = static_cast<uint32_t>(
        std::clamp(std::sqrt(static_cast<double>(triangles.size())), 1.0, 2048.0));
    triangles_.reserve(triangles.size());
    for (size_t t = 0; t < triangles.size(); ++t) {
        Flat flat;
        for (int i = 0; i < 3; ++i) {
            const glm::dvec3 p = positions[triangles[t][i]];
            snap(p, flat.u[i], flat.v[i]);
            flat.depth[i] = positions[triangles[t][i]][axis_];
        }
        const int64_t area = side(flat.u[0], flat.v[0], flat.u[1], flat.v[1], flat.u[2], flat.v[2]);
        if (area == 0) continue;  // seen edge-on: no shifted ray meets it
        flat.sign = area > 0 ? 1 : -1;
        flat.label = labels.empty() ? 0 : labels[t];
        triangles_.push_back(flat);
    }
    cellStart_.assign(size_t{cells_} * cells_ + 1, 0);
    const auto eachCell = [&](const Flat& flat, auto visit) {
        const auto [u0, u1] = std::minmax_element(flat.u.begin(), flat.u.end());
        const auto [v0, v1] = std::minmax_element(flat.v.begin(), flat.v.end());
        for (uint32_t y = cellOf(*v0); y <= cellOf(*v1); ++y)
            for (uint32_t x = cellOf(*u0); x <= cellOf(*u1); ++x) visit(size_t{y} * cells_ + x);
    };
    for (const Flat& flat : triangles_)
        eachCell(flat, [&](size_t cell) { ++cellStart_[cell + 1]; });
    for (size_t c = 1; c < cellStart_.size(); ++c) cellStart_[c] += cellStart_[c - 1];
    cellItems_.resize(cellStart_.back());
    std::vector<uint32_t> next(cellStart_.begin(), cellStart_.end() - 1);
    for (uint32_t t = 0; t < triangles_.size(); ++t)
        eachCell(triangles_[t], [&](size_t cell) { cellItems_[next[cell]++] = t; });
}

bool RayGrid::snap(const glm::dvec3& point, int32_t& u, int32_t& v) const {
    const int ua = (axis_ + 1) % 3;
    const int va = (axis_ + 2) % 3;
    const double x = (point[ua] - low_[ua]) * scale_[ua];
    const double y = (point[va] - low_[va]) * scale_[va];
    if (!(x >= 0 && x <= kGrid && y >= 0 && y <= kGrid)) return false;
    u = static_cast<int32_t>(x);
    v = static_cast<int32_t>(y);
    return true;
}

uint32_t RayGrid::cellOf(int32_t coordinate) const {
    return std::min(static_cast<uint32_t>(int64_t{coordinate} * cells_ / kGrid), cells_ - 1);
}

template <class Visit>
void RayGrid::visitCrossings(const glm::dvec3& point, Visit visit) const {
    int32_t pu = 0;
    int32_t pv = 0;
    if (!snap(point, pu, pv)) return;
    const size_t cell = size_t{cellOf(pv)} * cells_ + cellOf(pu);
    for (uint32_t i = cellStart_[cell]; i < cellStart_[cell + 1]; ++i) {
        const Flat& t = triangles_[cellItems_[i]];
        std::array<int64_t, 3> sides{};
        bool inside = true;
        for (int e = 0; e < 3 && inside; ++e) {
            const int n = (e + 1) % 3;
            sides[e] = side(t.u[e], t.v[e], t.u[n], t.v[n], pu, pv);
            inside = signAfterShift(sides[e], t.u[e], t.v[e], t.u[n], t.v[n]) == t.sign;
        }
        if (!inside) continue;
        // The side against an edge weighs the corner opposite to it.
        const auto w0 = static_cast<double>(sides[1]);
        const auto w1 = static_cast<double>(sides[2]);
        const auto w2 = static_cast<double>(sides[0]);
        const double depth = (w0 * t.depth[0] + w1 * t.depth[1] + w2 * t.depth[2]) / (w0 + w1 + w2);
        if (depth > point[axis_]) visit(t);
    }
}

int RayGrid::winding(const glm::dvec3& point) const {
    int sum = 0;
    visitCrossings(point, [&](const Flat& t) { sum += t.sign; });
    return sum;
}

void RayGrid::crossings(const glm::dvec3& point, std::vector<Crossing>& out) const {
    out.clear();
    visitCrossings(point, [&](const Flat& t) { out.push_back({t.label, t.sign}); });
}

}  // namespace sherd
