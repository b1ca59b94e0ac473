// SPDX-License-Identifier: MIT
// What must hold of every model that the importer returns.
#pragma once

#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

#include "fuzzed_promise.h"
#include "sherd/baker/import.h"

namespace sherd::fuzz {

inline void requirePromises(const SurfaceMesh& mesh) {
    require(mesh.corners.size() == mesh.triangles.size(), "every triangle has corners");
    require(mesh.triangleMaterials.size() == mesh.triangles.size(), "and a material");
    for (const glm::vec3& p : mesh.positions)
        require(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z),
                "a position is finite");
    for (const auto& t : mesh.triangles)
        for (const uint32_t v : t) require(v < mesh.positions.size(), "a vertex is in range");
    for (const uint32_t material : mesh.triangleMaterials)
        require(material < mesh.materials.size(), "a material is in range");
    for (const auto& attribute : mesh.attributes) {
        for (const auto& c : mesh.corners)
            for (const uint32_t v : c)
                require((size_t{v} + 1) * attribute.components <= attribute.values.size(),
                        "a corner's attribute is in range");
    }
}

/// The importer reads files, as it must find what lies beside them.
inline void importFile(const uint8_t* data, size_t size, const std::string& extension) {
    const std::filesystem::path path = std::filesystem::temp_directory_path() /
                                       ("sherd_fuzz_" + std::to_string(getpid()) + extension);
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
    const Result<Model> model = importModel(path, {});
    if (model) {
        for (const SurfaceMesh& mesh : model->meshes) requirePromises(mesh);
    } else {
        require(!model.error().message.empty(), "an error says what");
    }
}

}  // namespace sherd::fuzz
