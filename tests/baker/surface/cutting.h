// SPDX-License-Identifier: MIT
#pragma once

#include <doctest/doctest.h>

#include <glm/vec2.hpp>
#include <vector>

#include "support/plans.h"
#include "surface/components.h"
#include "surface/cut_surface.h"

namespace sherd::test {

inline FractureMap linesOf(const std::vector<std::vector<glm::dvec2>>& polylines,
                           uint32_t level = 1) {
    FractureMap map;
    for (const auto& points : polylines) map.lines.push_back({points, level, "test"});
    return map;
}

inline CutOptions cutOptions(double joinDistance, bool thesisPairing = false) {
    CutOptions options;
    options.seams = {joinDistance, thesisPairing};
    return options;
}

struct CutResult {
    MeshTopology before;
    CutSurface cut;
    Components components;
    uint32_t count() const { return components.count.back(); }
};

/// Cuts and checks what must hold of every cut.
inline CutResult cutAndCheck(const SurfaceMesh& mesh, const FractureMap& map,
                             double joinDistance = 0.01, uint32_t levels = 1) {
    CutResult result;
    result.before = buildTopology(mesh.positions, mesh.triangles);
    Result<CutSurface> cut = cutSurface(mesh, result.before, planOf(map), cutOptions(joinDistance));
    REQUIRE(cut.has_value());
    result.cut = std::move(*cut);
    CHECK(isFaithfulSplit(mesh, result.before, result.cut, 1e-6));
    result.components =
        floodFill(result.cut.surface, result.cut.topology, result.cut.lines, levels);
    return result;
}

}  // namespace sherd::test
