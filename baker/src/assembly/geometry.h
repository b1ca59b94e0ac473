// SPDX-License-Identifier: MIT
// Vertex and index buffers of a fracture set: outer faces with interpolated attributes, hidden
// faces with attributes of their own, all in the order of the hierarchy.
#pragma once

#include <glm/vec3.hpp>
#include <span>

#include "appearance/hidden_looks.h"
#include "assembly/hierarchy.h"
#include "sherd/baker/recipe.h"
#include "sherd/baker/surface_mesh.h"
#include "surface/split_surface.h"

namespace sherd {

struct AssemblyInput {
    const SurfaceMesh& mesh;
    const SplitSurface& surface;
    const Components& components;
    const Hierarchy& hierarchy;
    const HiddenLooks& hidden;
    std::span<const uint32_t> interiorMaterials;  ///< per material of the mesh: the one below it,
                                                  ///< as index into the set's materials
    const InteriorSettings& settings;
};

/// Fills `geometry` and `fragmentRanges` of the set.
void assembleGeometry(const AssemblyInput& input, FractureSet& set);

}  // namespace sherd
