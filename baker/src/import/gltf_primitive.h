// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "import/gltf_source.h"
#include "import/mesh_builder.h"

namespace sherd {

/// Where a primitive is and whom to tell about it.
struct PrimitiveContext {
    std::string pointer;  ///< JSON pointer of the primitive
    std::vector<std::string>* warnings = nullptr;
};

/// One primitive as triangles. Nothing for points and lines.
Result<std::optional<MeshPart>> readPrimitive(const GltfSource& source,
                                              const tinygltf::Primitive& primitive,
                                              const PrimitiveContext& context);

}  // namespace sherd
