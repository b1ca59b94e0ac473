// SPDX-License-Identifier: MIT
// Vertices on grids, and their entropy coding by Draco. Where the build has no Draco, encoding and
// decoding fail and say so.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "sherd/formats/fracture_set.h"
#include "sherd/formats/geometry_packing.h"
#include "sherd/formats/result.h"

namespace sherd {

/// Values on a grid of its own: value = q * step + origin of its component.
struct QuantizedAttribute {
    std::string semantic;
    uint32_t components = 0;
    std::vector<float> origin;  ///< per component
    float step = 1;
    std::vector<uint32_t> values;  ///< `components` per vertex
};

struct QuantizedMesh {
    uint32_t vertexCount = 0;
    std::vector<uint32_t> indices;
    std::vector<QuantizedAttribute> attributes;
};

/// Positions first, on one grid for all three axes, so that what was one place stays one. Vertices
/// that no triangle uses are left out. `badArgument` for values that are not finite.
Result<QuantizedMesh> quantize(const FractureGeometry& geometry, const GeometryPacking& packing);

/// The values of an attribute again. Normals and tangents are brought to unit length.
std::vector<float> dequantize(const QuantizedAttribute& attribute);

/// One Draco bitstream: version 2.2, sequential, so that triangles keep their order, with the
/// attributes as GENERIC integers under ids that count from 0. Loses nothing.
Result<std::vector<uint8_t>> encodeDraco(const QuantizedMesh& mesh);

/// What the file says the stream holds: counts, and the components of every attribute. Fills in
/// indices and values. Looks at what the stream claims before memory is taken for it; indices are
/// not checked.
Result<void> decodeDraco(std::span<const uint8_t> stream, uint32_t indexCount, QuantizedMesh& mesh);

}  // namespace sherd
