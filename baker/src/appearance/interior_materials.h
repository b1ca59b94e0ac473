// SPDX-License-Identifier: MIT
// Which material lies under which: the recipe names materials, bakes want their indices.
#pragma once

#include <optional>
#include <span>

#include "sherd/baker/bake.h"
#include "sherd/formats/glb_write.h"

namespace sherd {

struct ChosenMaterials {
    InteriorMaterials materials;
    std::optional<NewMaterial> added;  ///< the neutral one, if anything needs it: it becomes the
                                       ///< first material behind those of the document
};

/// Errors badArgument: a name that no material of the document has; with its pointer in the recipe
/// and the names there are.
Result<ChosenMaterials> chooseInteriorMaterials(const GltfDocument& document,
                                                std::span<const SurfaceMesh* const> meshes,
                                                const Recipe& recipe);

}  // namespace sherd
