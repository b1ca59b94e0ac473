// SPDX-License-Identifier: MIT
// What pieces are made of, by what covers them.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "appearance/hidden_mesh.h"
#include "assembly/hierarchy.h"
#include "sherd/baker/recipe.h"

namespace sherd {

struct PieceMaterialInput {
    const SurfaceMesh& mesh;
    const SplitSurface& surface;
    const Components& components;
    const Hierarchy& hierarchy;
    const HiddenMesh& hidden;
    const std::map<int32_t, std::string>& names;  ///< of materials, by glTF index
};

/// Per fragment the material, as number among the mesh's, that covers most of its outer surface;
/// the first of those that cover as much. A piece without outer surface is of what its hidden faces
/// lie under.
std::vector<uint32_t> coveringMaterials(const PieceMaterialInput& input);

/// What a material says of a fragment.
void apply(const PhysicalMaterial& material, Fragment& fragment);

/// Fragments of a material that is named get its name and what is said of it.
void assembleMaterials(const PieceMaterialInput& input,
                       const std::map<std::string, PhysicalMaterial>& materials, FractureSet& set);

}  // namespace sherd
