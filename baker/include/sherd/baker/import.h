// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sherd/baker/surface_mesh.h"
#include "sherd/formats/gltf_document.h"
#include "sherd/formats/result.h"

namespace sherd {

struct ImportOptions {
    std::vector<std::string>
        nodes;  ///< names or indices of mesh nodes; empty: every mesh node of the default scene
    uint32_t uvSet = 0;  ///< TEXCOORD_n in which lines are drawn
    bool join = false;   ///< the chosen nodes become one object, hung on the first of them
};

/// A source model: the document (kept as it was; made here for OBJ) and one mesh per object.
struct Model {
    GltfDocument document;
    std::vector<SurfaceMesh> meshes;
};

/// Reads `.glb`, `.gltf` or `.obj`.
Result<Model> importModel(const std::filesystem::path& path, const ImportOptions& options);

}  // namespace sherd
