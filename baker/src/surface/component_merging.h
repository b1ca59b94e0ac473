// SPDX-License-Identifier: MIT
// Merging components that are too small, or whose piece has no volume, into a neighbour.
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "surface/components.h"

namespace sherd {

/// The neighbour each leaf would be merged into: of those it stays together with down to the
/// deepest level, the one with the longest common border. kNone for a leaf without neighbours.
std::vector<uint32_t> bestNeighbours(const SplitSurface& surface, const MeshTopology& topology,
                                     const Components& components);

/// Merges every leaf into[leaf] != leaf; the merged leaf has the target's components at every
/// level. Leaves and components are numbered anew.
void mergeLeaves(Components& components, std::span<const uint32_t> into);

/// Surface area of each leaf, square metres.
std::vector<double> leafAreas(const SplitSurface& surface, const Components& components);

struct MergedLeaf {
    double area = 0;
    glm::dvec3 position{0.0};  ///< the centroid of its largest triangle
    uint32_t source = 0;       ///< the mesh triangle that lies on
};

/// Merges leaves whose share of the surface is below `minimumShare`.
std::vector<MergedLeaf> mergeSmallLeaves(const SplitSurface& surface, const MeshTopology& topology,
                                         double minimumShare, Components& components);

/// The centroid of each leaf's largest triangle, and its source: a place to point at in reports.
std::vector<MergedLeaf> placesOfLeaves(const SplitSurface& surface, const Components& components);

}  // namespace sherd
