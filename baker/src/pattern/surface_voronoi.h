// SPDX-License-Identifier: MIT
// The Voronoi cells of sites, cut into the surface: Euclidean bisectors, decided exactly.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "pattern/site_grid.h"
#include "surface/chords.h"
#include "surface/split_surface.h"

namespace sherd {

/// The borders of the cells within the given triangles.
///
/// triangles: of the surface, those the sites divide; index-degenerate ones left out.
/// sites: all different. line: mark of the borders.
std::vector<Chord> voronoiBorders(const SplitSurface& surface, std::span<const uint32_t> triangles,
                                  const SiteGrid& grid, const SiteTree& sites, uint32_t line);

}  // namespace sherd
