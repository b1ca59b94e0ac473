// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace sherd {

/// What Sherd takes over from a .mtl material.
struct ObjMaterial {
    std::string name;
    std::array<double, 4> baseColor{0.8, 0.8, 0.8, 1.0};  ///< linear RGB and opacity
    std::vector<uint8_t> image;                           ///< PNG or JPEG; empty: no texture
    std::string imageType;                                ///< MIME type
};

/// The named materials, looked up in `files` beside the model. What is missing or unreadable keeps
/// its defaults and is reported in `warnings`: a model without its materials can still be broken.
std::vector<ObjMaterial> loadObjMaterials(const std::vector<std::string>& names,
                                          const std::vector<std::string>& files,
                                          const std::filesystem::path& folder,
                                          std::vector<std::string>& warnings);

}  // namespace sherd
