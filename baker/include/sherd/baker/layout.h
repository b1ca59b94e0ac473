// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "sherd/baker/surface_mesh.h"
#include "sherd/formats/gltf_document.h"
#include "sherd/formats/result.h"

namespace sherd {

struct LayoutOptions {
    uint32_t resolution = 1024;  ///< side of the square drawing in user units, 16 to 65536
    std::string texture;         ///< shown below the wireframe: a data URI, "" for none
};

/// A drawing to draw fracture lines over.
struct Layout {
    std::string svg;
    size_t borderEdges = 0;  ///< chart borders drawn
    size_t innerEdges = 0;   ///< other edges drawn
    std::vector<std::string> warnings;
};

/// The UV layout of the meshes as an SVG template: a locked guide layer (wireframe, texture) that
/// the map reader passes over, and empty layers "level 1" to "level 3". Triangles are drawn where
/// their texture shows on the page (SurfaceMesh::placements), those of other tiles too, which is
/// reported. Error noTextureCoordinates: none of the meshes has any.
Result<Layout> makeLayoutSvg(std::span<const SurfaceMesh> meshes, const LayoutOptions& options);

/// The base-colour texture of the mesh's most used textured material as a data URI, "" if it has
/// none in the UV set lines are drawn in. Why one was left out goes to `warnings`.
std::string baseColorTexture(const GltfDocument& document, const SurfaceMesh& mesh,
                             std::vector<std::string>& warnings);

}  // namespace sherd
