// SPDX-License-Identifier: MIT
// Points spread over a surface: the sites of Voronoi cells.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "pattern/site_grid.h"
#include "surface/split_surface.h"

namespace sherd {

/// How many sites a place draws, 0..1: weights are those of the triangle's corners.
using Density = std::function<double(uint32_t triangle, const glm::dvec3& weights)>;

struct SamplingOptions {
    uint64_t seed = 1;
    double jitter = 0.5;  ///< 0: as far apart as can be had, 1: wherever chance puts them
    Density density;      ///< empty: everywhere alike
};

/// `count` different grid points on the given triangles, spread by best candidates (Mitchell 1991,
/// Spectrally optimal sampling for distribution ray tracing). Fewer where the surface has not that
/// many.
std::vector<SitePoint> sampleSites(const SplitSurface& surface, std::span<const uint32_t> triangles,
                                   uint32_t count, const SiteGrid& grid,
                                   const SamplingOptions& options);

/// The area of each triangle, weighted by the density in its middle.
std::vector<double> weightedAreas(const SplitSurface& surface, std::span<const uint32_t> triangles,
                                  const Density& density);

}  // namespace sherd
