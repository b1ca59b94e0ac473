// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "import/line_chains.h"
#include "sherd/baker/fracture_map.h"

namespace sherd {

/// Polylines of a named thing as lines to cut along. `label`: the thing, for reports ("node
/// \"a\"").
template <class ToScene>
void addSurfaceLines(const LineChains& chains, const std::string& label, uint32_t level,
                     const ToScene& toScene, std::vector<FractureMap::SurfaceLine>& lines) {
    size_t number = 0;
    for (const std::vector<glm::vec3>& points : chains.lines) {
        FractureMap::SurfaceLine& line = lines.emplace_back();
        line.level = level;
        line.source = label + ": line " + std::to_string(++number);
        line.places.reserve(points.size());
        for (const glm::vec3& p : points) line.places.push_back({true, toScene(glm::dvec3(p))});
    }
}

/// Says what chaining dropped, if anything.
void reportDropped(const LineChains& chains, const std::string& label,
                   std::vector<std::string>& warnings);

}  // namespace sherd
