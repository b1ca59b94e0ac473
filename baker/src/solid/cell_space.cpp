// SPDX-License-Identifier: MIT
#include "solid/cell_space.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "geometry/triangle.h"

namespace sherd {

std::optional<CellSpace> CellSpace::of(const CutSurface& cut, const Components& components) {
    std::vector<const CellLevel*> levels;
    for (uint32_t k = 1; k <= components.levels; ++k) {
        const auto found =
            std::find_if(cut.cells.begin(), cut.cells.end(),
                         [k](const CellLevel& c) { return c.level == k && c.sites != nullptr; });
        if (found == cut.cells.end() || cut.splitPatches) return std::nullopt;
        levels.push_back(&*found);
    }
    std::vector<double> largest(components.leafCount, -1);
    std::vector<uint32_t> triangle(components.leafCount, 0);
    for (uint32_t t = 0; t < cut.surface.triangles.size(); ++t) {
        const double area = triangleArea(cut.surface.positions, cut.surface.triangles[t].v);
        const uint32_t leaf = components.leaf[t];
        if (area <= largest[leaf]) continue;
        largest[leaf] = area;
        triangle[leaf] = t;
    }
    CellSpace space;
    space.leaves_.resize(components.leafCount);
    for (const CellLevel* level : levels) {
        space.levels_.push_back(level->sites.get());
        for (uint32_t leaf = 0; leaf < components.leafCount; ++leaf) {
            const uint32_t t = triangle[leaf];
            const uint32_t domain = level->domain[t];
            space.leaves_[leaf].push_back(
                {domain, level->cellOf(domain, cut.surface.triangles[t].source,
                                       centroidOf(cut.surface, t))});
        }
    }
    return space;
}

std::optional<CellSpace::Plane> CellSpace::between(uint32_t a, uint32_t b) const {
    for (size_t k = 0; k < levels_.size(); ++k) {
        const Cell& x = leaves_[a][k];
        const Cell& y = leaves_[b][k];
        if (x.domain != y.domain) return std::nullopt;
        if (x.number == y.number) continue;
        const glm::dvec3 s = levels_[k]->sites[x.number];
        const glm::dvec3 t = levels_[k]->sites[y.number];
        // |p - s|^2 - |p - t|^2 is linear in p, and p in the position.
        const auto value = [&](const glm::dvec3& position) {
            return glm::dot(2.0 * levels_[k]->place(position) - s - t, t - s);
        };
        Plane plane;
        plane.offset = value(glm::dvec3(0.0));
        for (int axis = 0; axis < 3; ++axis) {
            glm::dvec3 unit(0.0);
            unit[axis] = 1;
            plane.normal[axis] = value(unit) - plane.offset;
        }
        const double length = glm::length(plane.normal);
        if (!(length > 0)) return std::nullopt;
        plane.normal /= length;
        plane.offset /= length;
        return plane;
    }
    return std::nullopt;
}

}  // namespace sherd
