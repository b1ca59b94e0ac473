// SPDX-License-Identifier: MIT
// What tests ask of an imported mesh.
#pragma once

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "sherd/baker/surface_mesh.h"

namespace sherd::test {

inline double signedVolume(const SurfaceMesh& mesh) {
    double sum = 0;
    for (const auto& t : mesh.triangles) {
        const glm::dvec3 a(mesh.positions[t[0]]);
        const glm::dvec3 b(mesh.positions[t[1]]);
        const glm::dvec3 c(mesh.positions[t[2]]);
        sum += glm::dot(a, glm::cross(b, c)) / 6;
    }
    return sum;
}

/// Whether one of the warnings holds the text.
inline bool mentions(const std::vector<std::string>& warnings, const std::string& text) {
    return std::any_of(warnings.begin(), warnings.end(), [&](const std::string& warning) {
        return warning.find(text) != std::string::npos;
    });
}
inline bool mentions(const SurfaceMesh& mesh, const std::string& text) {
    return mentions(mesh.warnings, text);
}

}  // namespace sherd::test
