// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "sherd/formats/fracture_set.h"
#include "sherd/formats/geometry_packing.h"
#include "sherd/formats/gltf_document.h"
#include "sherd/formats/result.h"

namespace sherd {

/// A material to add to the document. FractureSet::materials values at or above the document's
/// own material count refer to these, in order.
struct NewMaterial {
    std::string name;
    std::array<float, 4> baseColor{0.6F, 0.58F, 0.55F, 1.0F};  ///< linear
    float metallic = 0;
    float roughness = 0.9F;
};

/// The document without `SHERD_mesh_fracture`: what attachFractureSets added is taken out again,
/// bytes and all, as long as no other tool has appended behind it or refers to it.
Result<GltfDocument> withoutFractureSets(const GltfDocument& document);

/// The document with the fracture sets hung on their nodes (`SHERD_mesh_fracture`; `node` and
/// `sameNodes`), as one GLB.
/// Everything the document held stays as it was, except fracture sets of an earlier bake: they are
/// replaced. `sourceHash` of each set is computed here, `mesh` is the one of the set's node. A node
/// is part of one set only. Material indices count in `document` as given. Geometry that is packed
/// moves a little; what was closed stays closed, which is checked as it is read back.
Result<std::vector<uint8_t>> attachFractureSets(const GltfDocument& document,
                                                std::span<const FractureSet> sets,
                                                std::span<const NewMaterial> newMaterials,
                                                const GeometryPacking& packing = {});

/// Writes the bytes whole or not at all: beside the target, flushed, then renamed over it.
Result<void> writeFileWhole(const std::filesystem::path& path, std::span<const uint8_t> bytes);

}  // namespace sherd
