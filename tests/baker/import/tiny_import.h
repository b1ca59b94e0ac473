// SPDX-License-Identifier: MIT
// Tiny models as the importer reads them.
#pragma once

#include <doctest/doctest.h>

#include <utility>
#include <vector>

#include "import/gltf_import.h"
#include "tiny_model.h"

namespace sherd::test {

inline Result<std::vector<SurfaceMesh>> import(const TinyModel& model,
                                               const ImportOptions& options = {}) {
    return importGltf(model.document(), "t.glb", options);
}

inline std::vector<SurfaceMesh> importAll(const TinyModel& model,
                                          const ImportOptions& options = {}) {
    auto meshes = import(model, options);
    REQUIRE_MESSAGE(meshes, (meshes ? "" : meshes.error().message + meshes.error().where));
    return std::move(*meshes);
}

inline SurfaceMesh importOne(const TinyModel& model, uint32_t uvSet = 0) {
    std::vector<SurfaceMesh> meshes = importAll(model, {{}, uvSet});
    REQUIRE(meshes.size() == 1);
    return std::move(meshes.front());
}

/// Adds a node of the scene, or a child of `parent`; returns its index.
inline int addNode(TinyModel& model, Json made, int parent = -1) {
    model.json["nodes"].push_back(std::move(made));
    const int index = static_cast<int>(model.json["nodes"].size()) - 1;
    if (parent < 0) {
        model.json["scenes"][0]["nodes"].push_back(index);
    } else {
        model.json["nodes"][static_cast<size_t>(parent)]["children"].push_back(index);
    }
    return index;
}

}  // namespace sherd::test
