// SPDX-License-Identifier: MIT
// Makes a glTF document self-contained.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sherd/formats/gltf_document.h"
#include "sherd/formats/result.h"

namespace sherd {

/// The two chunks of a GLB, unchanged; only the container is checked.
Result<GltfDocument> splitGlb(std::span<const uint8_t> bytes, const std::string& name);

/// Takes in every buffer and image that is not in the binary chunk yet. A document without any is
/// left bit for bit. `folder`: where relative URIs start; without one only data URIs are read.
Result<GltfDocument> takeInResources(GltfDocument document,
                                     const std::optional<std::filesystem::path>& folder,
                                     const std::string& name);

/// "%20" and the like resolved; nothing for a malformed escape.
std::optional<std::string> percentDecoded(const std::string& uri);

/// The payload of "data:<type>;base64,<payload>"; nothing when malformed.
std::optional<std::vector<uint8_t>> dataUriBytes(const std::string& uri);

}  // namespace sherd
