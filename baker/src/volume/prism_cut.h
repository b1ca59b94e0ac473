// SPDX-License-Identifier: MIT
// Cuts a closed mesh straight through by a drawing: into the prisms over its cells.
//
// All that is decided is on which side of lines points of the plane lie, and in what order
// triangles follow each other over a node of the drawing; see `prism_map.h`. What comes of it is
// that of `mesh_cut.h`, cells being those of the drawing, and closed for the same reason: caps have
// the sections that the skin has, and the stretches over nodes inside.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <span>

#include "volume/mesh_cut.h"
#include "volume/prism_map.h"

namespace sherd {

/// positions, triangles, grid: as for `cutMesh`. axis: 0 to 2, along which the drawing is
/// projected; its x is the next axis, its y the one after. Cells of one face of the drawing are one
/// piece: see `PrismMap::faces`. Errors: noTriangles, invalidData, openMesh, internal.
Result<MeshCut> cutByPrisms(std::span<const glm::vec3> positions,
                            std::span<const std::array<uint32_t, 3>> triangles, const CutGrid& grid,
                            const PrismMap& map, uint32_t axis, const MeshCutOptions& options = {});

}  // namespace sherd
