// SPDX-License-Identifier: MIT
// Thesis step 7 (Casella 2013, 4.9): every component is closed by its hidden sheet and by walls
// from its border to the border of the sheet. Piece of a component C: C - M(C) - Wall(border of C).
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "interior/hidden_sheet.h"
#include "surface/components.h"
#include "surface/mesh_topology.h"

namespace sherd {

/// A corner of the split surface (3 * triangle + k), or the hidden point of a corner of the sheet,
/// or a hub of the sheet.
struct CornerRef {
    static constexpr uint32_t kFirstHub = 0x7F000000;  ///< hidden ones from here on are hubs
    uint32_t corner : 31;
    uint32_t hidden : 1;
    bool isHub() const { return hidden != 0 && corner >= kFirstHub; }
};

struct HiddenFace {
    std::array<CornerRef, 3> corners;
    uint32_t leaf = 0;
    uint32_t exposedFrom = 1;
    uint32_t neighbour = kNone;  ///< the leaf across a wall; kNone for a sheet and for a rim
    bool wall = false;
    uint32_t under = kNone;  ///< a triangle of the split surface whose material it has; kNone: that
                             ///< which its corners hang from
};

/// Leaves that are closed by walls straight through the solid, without a sheet.
struct SolidLeaves {
    std::vector<uint8_t> solid;     ///< per leaf; empty: none is
    std::vector<HiddenFace> faces;  ///< their walls
    std::vector<glm::vec3> hubs;    ///< points inside the solid that these use
    uint32_t strays = 0;  ///< bits of cells that went to a neighbour, hanging together with
                          ///< the rest neither outside nor inside

    bool contains(uint32_t leaf) const { return !solid.empty() && solid[leaf] != 0; }
    bool containsAll() const {
        return !solid.empty() && std::find(solid.begin(), solid.end(), 0) == solid.end();
    }
};

/// The hidden faces of all leaves, in the order of the sheet's triangles, then those of solid ones.
/// A wall shows from the level at which its two leaves part, a sheet from level 1, and so does a
/// wall with a solid leaf on one side only: what closes the two does not match. A closed part that
/// no line of any level divides has neither. Open borders of the mesh get a wall (a rim) of their
/// own, exposed from level 1.
std::vector<HiddenFace> stitch(const SplitSurface& surface, const MeshTopology& topology,
                               const HiddenSheet& sheet, const Components& components,
                               const SolidLeaves& solid = {});

/// The split vertex of an outer corner, the sheet's vertex of a hidden one.
inline uint32_t vertexOf(const SplitSurface& surface, const HiddenSheet& sheet, CornerRef ref) {
    if (ref.isHub()) {
        const auto firstHub = static_cast<uint32_t>(sheet.points.size()) - sheet.hubs;
        return firstHub + (ref.corner - CornerRef::kFirstHub);
    }
    return ref.hidden != 0 ? sheet.triangles[ref.corner / 3].v[ref.corner % 3]
                           : surface.triangles[ref.corner / 3].v[ref.corner % 3];
}
inline const glm::vec3& positionOf(const SplitSurface& surface, const HiddenSheet& sheet,
                                   CornerRef ref) {
    const uint32_t v = vertexOf(surface, sheet, ref);
    return ref.hidden != 0 ? sheet.points[v] : surface.positions[v];
}

/// Vertex ids (2 * class + hidden) of all faces of all fragments of one level, outer and hidden,
/// such that a component that touches itself at a vertex has one id for each of its fans there. The
/// surface's triangles come first, then the hidden ones that show.
std::vector<std::array<uint32_t, 3>> levelTopology(const SplitSurface& surface,
                                                   const MeshTopology& topology,
                                                   const HiddenSheet& sheet,
                                                   const Components& components,
                                                   std::span<const HiddenFace> hidden,
                                                   uint32_t level, const SolidLeaves& solid = {});

}  // namespace sherd
