// SPDX-License-Identifier: MIT
// Cuts a closed mesh into the cells of a complex.
//
// mesh + cells, on one grid -> polygons of triangles in cells -> stretches of the cells' edges
// inside -> one cap per face between cells. Every piece is its part of the skin and its caps, and
// closed because its borders are the same implicit vertices on both sides; see `face_caps.h`.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "sherd/formats/result.h"
#include "volume/cap_triangle.h"
#include "volume/cell_family.h"
#include "volume/cut_grid.h"

namespace sherd {

struct MeshCut {
    static constexpr uint32_t kWhole = 0xFFFFFFFFU;

    /// A triangle of the mesh, or part of one.
    struct SkinTriangle {
        std::array<uint32_t, 3> v;  ///< into positions
        uint32_t source;            ///< triangle of the mesh
        uint32_t weights;           ///< into `weights`; kWhole: its corners are the source's
    };
    /// Of each corner: the weights of the source's corners there.
    using CornerWeights = std::array<glm::dvec3, 3>;
    /// The face between two cells; triangles counter-clockwise seen from the higher.
    struct Cap {
        uint32_t low, high;     ///< cells, low < high
        uint32_t first, count;  ///< of capTriangles
    };

    std::vector<glm::vec3> positions;  ///< the mesh's first, bit by bit; then the cut's
    std::vector<SkinTriangle> skin;    ///< by cell
    std::vector<uint32_t> skinStart;   ///< per cell, and one more
    std::vector<CornerWeights> weights;
    std::vector<CapTriangle> capTriangles;
    std::vector<Cap> caps;  ///< ascending by low, high

    /// Per triangle of the mesh which part without a connection to others it is of; empty if no
    /// vertices were united.
    std::vector<uint32_t> parts;
    CellFunctions functions;  ///< the cells as cut: planes moved off faces that lay in them

    /// What needed more than the ordinary course.
    struct Report {
        uint32_t movedPlanes = 0;    ///< off faces that lay in them; see `coplanar_faces.h`
        uint32_t opposedPlanes = 0;  ///< of these, with faces that wanted it otherwise
        uint32_t crossedCaps = 0;    ///< the mesh crosses itself there
        uint32_t fans = 0;           ///< caps that are closed but folded
        uint32_t united = 0;         ///< vertices found in one place with another
    };
    Report report;

    uint32_t cells() const { return static_cast<uint32_t>(skinStart.size()) - 1; }
    std::span<const SkinTriangle> skinOf(uint32_t cell) const {
        return std::span(skin).subspan(skinStart[cell], skinStart[cell + 1] - skinStart[cell]);
    }
    std::span<const CapTriangle> trianglesOf(const Cap& cap) const {
        return std::span(capTriangles).subspan(cap.first, cap.count);
    }
};

struct MeshCutOptions {
    /// The cells cut other meshes, too, of which some have triangles of this one from their other
    /// side, the same vertices ascending alike. Planes stay where they are (see `settleCells`), and
    /// such triangles are cut into the same parts, to the bit.
    bool shared = false;
};

/// positions, triangles: closed over vertex ids (every edge used as often in either direction),
/// facing outwards; it may touch, overlap or cross itself. grid: around it. Errors: noTriangles,
/// invalidData, openMesh, internal.
Result<MeshCut> cutMesh(std::span<const glm::vec3> positions,
                        std::span<const std::array<uint32_t, 3>> triangles, const CutGrid& grid,
                        CellFunctions cells, const MeshCutOptions& options = {});

/// Cells with their planes moved off the faces of a mesh that lie in them, as `cutMesh` does unless
/// the cells are shared.
struct SettledCells {
    CellFunctions functions;
    uint32_t moved = 0;    ///< planes
    uint32_t opposed = 0;  ///< of these, with faces that wanted it otherwise
};
Result<SettledCells> settleCells(std::span<const glm::vec3> positions,
                                 std::span<const std::array<uint32_t, 3>> triangles,
                                 const CutGrid& grid, CellFunctions cells);

}  // namespace sherd
