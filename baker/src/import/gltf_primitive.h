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

/// The primitive's positions, all finite.
Result<std::vector<glm::vec3>> readPositions(const GltfSource& source, int accessor,
                                             const PrimitiveContext& context);

/// The vertices in the order in which the primitive uses them: its indices, or 0, 1, 2, ...
Result<std::vector<uint32_t>> readVertexOrder(const GltfSource& source,
                                              const tinygltf::Primitive& primitive,
                                              size_t vertexCount, const PrimitiveContext& context);

/// Refuses what has no single shape.
Result<void> refuseSkinned(const GltfSource& source, const tinygltf::Primitive& primitive,
                           const PrimitiveContext& context);

/// One primitive as triangles. Nothing for lines (gltf_lines.h) and for points, which are reported.
Result<std::optional<MeshPart>> readPrimitive(const GltfSource& source,
                                              const tinygltf::Primitive& primitive,
                                              const PrimitiveContext& context);

}  // namespace sherd
