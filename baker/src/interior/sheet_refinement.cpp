// SPDX-License-Identifier: MIT
#include "interior/sheet_refinement.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "geometry/edge_refinement.h"

namespace sherd {
namespace {

/// What refineEdges asks.
struct SheetTarget {
    struct Middle {
        VertexOrigin origin;
        glm::vec3 foot, point;
    };
    const SurfaceMesh& mesh;
    const SplitSurface& surface;
    const HiddenMap& map;
    const SheetRefinement& options;
    HiddenSheet& sheet;

    std::array<uint32_t, 2> endsOf(uint32_t h) const {
        const auto& v = sheet.triangles[h / 3].v;
        return {v[h % 3], v[(h + 1) % 3]};
    }
    double length2(uint32_t h) const {
        const auto [a, b] = endsOf(h);
        const glm::dvec3 d = glm::dvec3(sheet.feet[a]) - glm::dvec3(sheet.feet[b]);
        return glm::dot(d, d);
    }
    double shortest2() const { return options.shortest * options.shortest; }
    Middle middleOf(uint32_t h) const {
        const auto [a, b] = endsOf(h);
        const uint32_t source = surface.triangles[sheet.triangles[h / 3].parent].source;
        const VertexOrigin origin =
            middleOrigin(sheet.origins[a], sheet.origins[b], mesh.triangles[source]);
        return {origin, glm::vec3(0.5 * (glm::dvec3(sheet.feet[a]) + glm::dvec3(sheet.feet[b]))),
                glm::vec3(map(source, origin.weights))};
    }
    bool isEven(uint32_t h, const Middle& middle) const {
        const auto [a, b] = endsOf(h);
        const glm::dvec3 point(middle.point), foot(middle.foot);
        const glm::dvec3 mean = 0.5 * (glm::dvec3(sheet.points[a]) + glm::dvec3(sheet.points[b]));
        const double depth = std::max(glm::distance(point, foot), glm::distance(mean, foot));
        return glm::distance(mean, point) <= std::min(options.tolerance, options.ofDepth * depth);
    }
    uint32_t add(Middle&& middle) {
        sheet.origins.push_back(middle.origin);
        sheet.feet.push_back(middle.foot);
        sheet.points.push_back(middle.point);
        return static_cast<uint32_t>(sheet.feet.size() - 1);
    }
};

}  // namespace

void refineSheet(const SurfaceMesh& mesh, const SplitSurface& surface, const HiddenMap& map,
                 const SheetRefinement& options, HiddenSheet& sheet) {
    SheetTarget target{mesh, surface, map, options, sheet};
    refineEdges(sheet, target, options.threads);
}

}  // namespace sherd
