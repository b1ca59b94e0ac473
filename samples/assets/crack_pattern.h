// SPDX-License-Identifier: MIT
// Cracks as the borders of cells in space, traced over the surface and drawn into its UV charts.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "mesh.h"

namespace sherd::samples {

/// A cell is what lies nearest to its site, seen through a space bent by noise: its borders wander
/// as cracks do, and run through the thickness of a wall, so both skins crack at the same place.
struct CrackSite {
    glm::dvec3 position{0.0};
    uint32_t cell = 0;  ///< the level-1 cell a level-2 site divides; unused for level 1
};

struct CrackOptions {
    glm::dvec3 stretch{1.0};   ///< distances are measured after scaling by this
    double bend = 0.02;        ///< metres by which the noise moves a place
    double bendSize = 0.08;    ///< metres across its largest features
    uint32_t octaves = 4;      ///< each adds finer jaggedness
    uint32_t subdivision = 4;  ///< each triangle is traced as subdivision^2 smaller ones
    uint32_t seed = 1;
};

/// Scatters sites for level 2 in each level-1 cell.
struct ScatterOptions {
    std::vector<uint32_t> counts;  ///< sites per level-1 cell; 1 leaves it whole
    glm::dvec3 impact{0.0};        ///< pieces are smaller near this place
    double depth = 0;              ///< metres: sites lie this far below the skin
    uint32_t seed = 1;
};

struct CrackPattern {
    CrackOptions options;
    std::vector<CrackSite> level1;
    std::vector<CrackSite> level2;
};

std::vector<CrackSite> scatterSites(const Mesh& mesh, const CrackPattern& pattern,
                                    const ScatterOptions& scatter);

/// A straight piece of a crack inside one triangle, in UV. Where it ends on a chart's rim, the
/// outward normal of that rim says where to draw on; elsewhere it is zero.
struct CrackSegment {
    glm::dvec2 from{0.0}, to{0.0};
    glm::dvec2 fromOutward{0.0}, toOutward{0.0};
};

struct TracedCracks {
    std::vector<CrackSegment> level1, level2;  ///< level2: the additional lines only
    std::vector<double> areas1, areas2;  ///< m^2 of each connected piece of surface, per level
};

TracedCracks traceCracks(const Mesh& mesh, const CrackPattern& pattern);

}  // namespace sherd::samples
