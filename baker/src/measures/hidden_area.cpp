// SPDX-License-Identifier: MIT
#include "measures/hidden_area.h"

#include "geometry/triangle.h"

namespace sherd {

std::vector<FragmentArea> fragmentAreas(const ShownTriangles& shown) {
    std::vector<FragmentArea> areas(shown.set().fragments.size());
    for (uint32_t i = 0; i < shown.triangles().size(); ++i) {
        const ShownTriangles::Triangle& t = shown.triangles()[i];
        const double area = triangleArea(shown.set().geometry.positions, t.v);
        shown.forEachShowing(i, [&](uint32_t f) {
            areas[f].whole += area;
            if (t.exposedFrom > 0) areas[f].hidden += area;
        });
    }
    return areas;
}

}  // namespace sherd
