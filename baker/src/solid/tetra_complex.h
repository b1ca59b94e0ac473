// SPDX-License-Identifier: MIT
// A solid filled with tetrahedra that fit its split surface: cut into small cells, whose lumps are
// divided by cones from a point that sees all their faces.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "solid/skin_surface.h"
#include "surface/mesh_topology.h"

namespace sherd {

struct TetraComplex {
    /// Corners 0 to 2 go counter-clockwise seen from beyond their face; it is the tetrahedron's
    /// share of its lump's surface. Corner 3 is the lump's core.
    struct Tetra {
        std::array<uint32_t, 4> v{};
        /// Per face, named by the corner across it: the tetrahedron there; kNone: the skin.
        std::array<uint32_t, 4> across{kNone, kNone, kNone, kNone};
        uint32_t skin = kNone;  ///< triangle of the skin that is its face 3
        uint32_t lump = 0;
    };
    CutSkin skin;
    std::vector<glm::vec3> positions;  ///< the skin's vertices first
    uint32_t firstCore = 0;            ///< from here on they are lumps' cores
    std::vector<Tetra> tetras;
    /// Per lump: its core sees all its faces, so that any part of it may go to any piece.
    std::vector<uint8_t> star;
    std::vector<std::array<uint32_t, 2>> capSides;  ///< tetrahedra on both sides of each cap
                                                    ///< triangle, the lower cell's first
    double rounding = 0;  ///< metres: by how much rounding to floats may turn one over

    bool onSkin(uint32_t vertex) const { return vertex < skin.positions.size(); }
};

/// Corners of a face, counter-clockwise seen from outside.
inline constexpr std::array<std::array<size_t, 3>, 4> kTetraFaces = {
    {{2, 1, 3}, {0, 2, 3}, {1, 0, 3}, {0, 1, 2}}};

/// Nothing where the surface is not closed or cannot be cut.
std::optional<TetraComplex> fillWithTetras(const SplitSurface& surface,
                                           std::span<const glm::dvec3> sites);

}  // namespace sherd
