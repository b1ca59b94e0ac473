// SPDX-License-Identifier: MIT
#pragma once

#include <tiny_gltf.h>

#include <string>
#include <vector>

#include "import/texture_placement.h"
#include "sherd/formats/gltf_document.h"
#include "sherd/formats/result.h"

namespace sherd {

/// A glTF document as the importer sees it: structure parsed by tinygltf, bytes left in the
/// document.
struct GltfSource {
    const GltfDocument* document = nullptr;  ///< outlives this
    std::string name;                        ///< file name, for errors
    tinygltf::Model model;                   ///< no images, buffers, materials, animations
    size_t materialCount = 0;
    std::vector<MaterialPicture> pictures;  ///< per material

    /// "lamp.glb#/accessors/3"
    std::string where(const std::string& pointer) const { return name + "#" + pointer; }
};

/// Parses the structure. Refuses required extensions that would change the geometry unread.
Result<GltfSource> parseGltfSource(const GltfDocument& document, const std::string& name);

}  // namespace sherd
