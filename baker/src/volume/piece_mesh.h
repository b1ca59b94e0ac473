// SPDX-License-Identifier: MIT
// The closed meshes of a cut's pieces: skin and caps of their cells, every vertex one fan.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "volume/mesh_cut.h"

namespace sherd {

struct PieceMesh {
    /// Where a triangle comes from.
    struct Origin {
        bool cap = false;
        uint32_t index = 0;  ///< into MeshCut::skin or capTriangles (turned round for the higher)
    };
    std::vector<uint32_t> vertices;  ///< into MeshCut::positions; one twice where fans meet in it
    std::vector<std::array<uint32_t, 3>> triangles;  ///< into `vertices`
    std::vector<Origin> origins;                     ///< per triangle
    uint32_t lumps = 0;                              ///< parts that share no vertex
    double volume = 0;                               ///< in the cube of the positions' unit

    std::vector<glm::vec3> positions(const MeshCut& cut) const;
};

struct PieceOptions {
    /// Per cell; those of the same number are one piece, without caps between them. Empty: each
    /// cell a piece of its own.
    std::span<const uint32_t> groups;
    /// A piece of less than this share of the whole volume becomes part of the neighbour it shares
    /// most area with, the largest if it touches none: planes that all but meet leave slivers that
    /// no float can hold. 0 to 1.
    double smallestShare = 1e-9;
    /// Likewise one that is thinner than this: of less volume than a film so thick over half of its
    /// surface. In the positions' unit; 0: none is.
    double thinnest = 0;
};

struct CutPieces {
    static constexpr uint32_t kNone = 0xFFFFFFFFU;
    std::vector<PieceMesh> pieces;      ///< none empty; by their first cell
    std::vector<uint32_t> pieceOfCell;  ///< kNone: nothing of the mesh is in it
    std::vector<uint32_t> mainCell;     ///< per piece: the cell that holds most of it, of several
    uint32_t slivers = 0;               ///< pieces that became part of another
};

/// Triangles that became flat because vertices are in one place are left out. Where a piece touches
/// itself along an edge whose ends cannot be told apart (the mesh crosses itself there), one of the
/// edge's uses is halved: then `cut` gains vertices and triangles.
CutPieces assemblePieces(MeshCut& cut, const PieceOptions& options = {});

}  // namespace sherd
