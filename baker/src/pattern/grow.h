// SPDX-License-Identifier: MIT
// Patterns whose cells are cut straight into the surface: Voronoi and wood.
#pragma once

#include "pattern/site_sampling.h"
#include "sherd/baker/pattern.h"
#include "surface/chords.h"
#include "surface/pieces.h"

namespace sherd {

/// The surface as the levels before have left it.
struct GrowthInput {
    const SplitSurface& surface;
    const MeshTopology& topology;
    const PartGroups& groups;
    const std::vector<uint32_t>& piece;  ///< per triangle: its piece of the level before
    glm::dvec3 grain{0.0};               ///< wood: unit length
    Density density{};
};

/// Per triangle what a pattern divides apart from the rest: a piece in one group of parts.
struct Domains {
    std::vector<uint32_t> ofTriangle;
    std::vector<std::vector<uint32_t>> triangles;
};
Domains findDomains(const GrowthInput& input);

struct Growth {
    std::vector<Chord> chords;
    CellLevel cells;
};

/// `pattern.count` cells over all domains, by their (weighted) area, at least one each. line: mark
/// of their borders.
Growth growCells(const GrowthInput& input, const Pattern& pattern, uint32_t level, uint32_t line);

}  // namespace sherd
