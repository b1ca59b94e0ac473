// SPDX-License-Identifier: MIT
// Vertex and index buffers of a fracture set: outer faces with interpolated attributes, hidden
// faces with attributes of their own, all in the order of the hierarchy.
#pragma once

#include <glm/vec3.hpp>
#include <span>

#include "assembly/hierarchy.h"
#include "interior/stitching.h"
#include "sherd/baker/surface_mesh.h"
#include "surface/split_surface.h"

namespace sherd {

struct AssemblyInput {
    const SurfaceMesh& mesh;
    const SplitSurface& surface;
    const Components& components;
    const Hierarchy& hierarchy;
    std::span<const HiddenFace> faces;
    const HiddenSheet& sheet;
    uint32_t interiorMaterial;  ///< index into the set's materials
    double uvMetresPerTile;
};

/// Fills `geometry` and `fragmentRanges` of the set.
void assembleGeometry(const AssemblyInput& input, FractureSet& set);

}  // namespace sherd
