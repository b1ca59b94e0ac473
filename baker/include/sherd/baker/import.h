// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sherd/baker/recipe.h"
#include "sherd/baker/surface_mesh.h"
#include "sherd/formats/gltf_document.h"
#include "sherd/formats/result.h"

namespace sherd {

struct ImportOptions {
    std::vector<std::string>
        nodes;  ///< names or indices of mesh nodes; empty: every mesh node of the default scene
    uint32_t uvSet = 0;        ///< TEXCOORD_n in which lines are drawn
    bool join = false;         ///< the chosen nodes become one object, hung on the first of them
    bool nodeRecipes = false;  ///< read the recipes that nodes carry. Where there are any and no
                               ///< nodes are chosen, only their objects, and those on which lines
                               ///< are modelled, are taken
    bool wholeScene = false;   ///< take the others, too
    /// Of the recipe for nodes that bring none. Nodes of one mesh that anchors hold otherwise are
    /// different objects.
    std::vector<RecipeAnchor> anchors = {};
    /// Metres per unit of the scene (see Recipe); empty: as nodes' recipes say.
    std::optional<double> unitScale = {};
};

/// A source model: the document (kept as it was; made here for OBJ) and one mesh per object.
struct Model {
    GltfDocument document;
    std::vector<SurfaceMesh> meshes;
    std::vector<Recipe> recipes;        ///< that nodes carry: `extras.sherd`
    std::vector<int32_t> recipeOfMesh;  ///< per mesh into recipes, -1: none; empty: not read
    size_t unreadRecipes = 0;           ///< so many nodes or meshes carry one that was not read
};

/// Reads `.glb`, `.gltf` or `.obj`, and the recipes that a scene carries, if they are asked for.
Result<Model> importModel(const std::filesystem::path& path, const ImportOptions& options);

}  // namespace sherd
