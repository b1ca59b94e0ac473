// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "sherd/formats/result.h"

namespace sherd {

/// A glTF document in one piece: its JSON text and the content of buffer 0.
/// Self-contained: external buffers and images of a `.gltf` have been taken in.
struct GltfDocument {
    std::string json;
    std::vector<uint8_t> bin;
};

/// Reads `.glb` or `.gltf`. Refuses truncated files, nesting deeper than 128, sizes that overrun
/// the file.
Result<GltfDocument> loadGltfDocument(const std::filesystem::path& path);

/// The same from the bytes of a `.glb`. `name` is used in errors.
Result<GltfDocument> parseGlb(std::span<const uint8_t> bytes, const std::string& name);

/// The bytes of a GLB holding the document.
std::vector<uint8_t> toGlb(const GltfDocument& document);

}  // namespace sherd
