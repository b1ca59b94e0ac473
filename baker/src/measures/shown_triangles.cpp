// SPDX-License-Identifier: MIT
#include "measures/shown_triangles.h"

#include <algorithm>

#include "geometry/morton_order.h"

namespace sherd {

ShownTriangles::ShownTriangles(const FractureSet& set) : set_(set) {
    const std::vector<Primitive>& primitives = set.geometry.primitives;
    for (const Fragment& fragment : set.fragments) {
        level_.push_back(fragment.level);
        parent_.push_back(static_cast<uint32_t>(std::max(fragment.parent, 0)));
    }
    std::vector<Triangle> triangles;
    std::vector<glm::vec3> middles;
    triangles.reserve(set.geometry.indices.size() / 3);
    middles.reserve(set.geometry.indices.size() / 3);
    for (uint32_t f = 0; f < set.fragments.size(); ++f) {
        if (set.fragments[f].children.count > 0) continue;
        for (size_t p = 0; p < primitives.size(); ++p) {
            const Range range = set.fragmentRanges[f * primitives.size() + p];
            for (uint32_t i = range.first; i < range.first + range.count; i += 3) {
                const uint32_t* v = set.geometry.indices.data() + i;
                triangles.push_back(
                    {{v[0], v[1], v[2]}, f, primitives[p].exposedFrom, primitives[p].sheet});
                const auto& at = set.geometry.positions;
                middles.push_back(at[v[0]] / 3.0F + at[v[1]] / 3.0F + at[v[2]] / 3.0F);
            }
        }
    }
    triangles_.reserve(triangles.size());
    for (const uint32_t t : mortonOrder(middles).items) triangles_.push_back(triangles[t]);
}

std::vector<std::array<uint32_t, 3>> ShownTriangles::corners() const {
    std::vector<std::array<uint32_t, 3>> corners;
    corners.reserve(triangles_.size());
    for (const Triangle& t : triangles_) corners.push_back(t.v);
    return corners;
}

}  // namespace sherd
