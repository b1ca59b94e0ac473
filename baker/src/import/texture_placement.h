// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "sherd/baker/surface_mesh.h"

namespace sherd {

/// How a glTF material puts its picture, the base-colour texture, on surfaces.
struct MaterialPicture {
    std::string label;     ///< "material \"bark\"", for reports
    bool present = false;  ///< there is one
    uint64_t uvSet = 0;    ///< TEXCOORD_n it lies in
    TexturePlacement placement;
    std::string problem;  ///< what of it makes no sense; the placement is plain then
};

/// One per material, whatever the document holds.
std::vector<MaterialPicture> readMaterialPictures(const nlohmann::json& document);

/// Fills in the mesh's placements. Pictures in another UV set than the one lines are drawn in, and
/// those that make no sense, are plain and reported.
void placeTextures(const std::vector<MaterialPicture>& pictures, SurfaceMesh& mesh);

}  // namespace sherd
