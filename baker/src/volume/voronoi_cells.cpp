// SPDX-License-Identifier: MIT
#include "volume/voronoi_cells.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

namespace sherd {
namespace {

/// What squared lengths along an axis count for: weight / 2^bits of what they are.
struct Metric {
    int bits = 0;
    std::array<int64_t, 3> weight{1, 1, 1};
};

Metric metricOf(const glm::dvec3& stretch) {
    const double least = std::min({stretch.x, stretch.y, stretch.z});
    const double most = std::max({stretch.x, stretch.y, stretch.z});
    Metric metric;
    // The smallest weight is 16 or more: within 3 % of what it should be.
    if (most > least) metric.bits = static_cast<int>(std::ceil(4 + 2 * std::log2(most / least)));
    for (int k = 0; k < 3; ++k) {
        const double share = least / stretch[k];
        metric.weight[static_cast<size_t>(k)] =
            std::llround(std::ldexp(share * share, metric.bits));
    }
    return metric;
}

}  // namespace

Result<CellFamily> voronoiCells(std::span<const glm::dvec3> sites, const CutGrid& grid,
                                const glm::dvec3& stretch) {
    for (int k = 0; k < 3; ++k) {
        if (!(stretch[k] >= 1 && stretch[k] <= kMostStretch))
            return fail(ErrorCode::badArgument, "cells can be stretched by 1 to 64");
    }
    const Metric metric = metricOf(stretch);
    // With sites in steps of `unit`, slopes 2 w s / 2^bits and offsets w s^2 / 2^bits are whole.
    const int64_t unit = metric.bits == 0 ? 1 : int64_t{1} << (metric.bits - 1);
    CellFamily family;
    for (size_t i = 0; i < sites.size(); ++i) {
        const glm::dvec3 place = grid.toGrid(sites[i]);
        LinearFunction f;
        glm::dvec3 snapped;
        for (int k = 0; k < 3; ++k) {
            if (!(std::abs(place[k]) <= CutGrid::kFarthest)) {
                return fail(ErrorCode::badArgument,
                            "a site is no number, or farther than twice the mesh's extent from it",
                            "site " + std::to_string(i));
            }
            const int64_t s = std::llround(place[k] / static_cast<double>(unit));
            const int64_t w = metric.weight[static_cast<size_t>(k)];
            snapped[k] = static_cast<double>(s * unit);
            const int64_t slope = metric.bits == 0 ? -2 * s : -w * s;
            (k == 0 ? f.x : k == 1 ? f.y : f.z) = slope;
            f.c += metric.bits == 0 ? s * s : w * s * s * unit / 2;
        }
        family.functions.push_back(f);
        family.sites.push_back(snapped);
    }
    for (int k = 0; k < 3; ++k) {
        const auto w = static_cast<double>(metric.weight[static_cast<size_t>(k)]);
        family.metric[k] = std::sqrt(std::ldexp(w, -metric.bits));
    }
    return family;
}

}  // namespace sherd
