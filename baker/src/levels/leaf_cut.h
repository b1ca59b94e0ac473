// SPDX-License-Identifier: MIT
// One leaf, taken out of the object and cut.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "levels/drawn_prisms.h"
#include "levels/piece_model.h"
#include "sherd/baker/volume_cut.h"
#include "volume/mesh_cut.h"
#include "volume/piece_mesh.h"

namespace sherd {

/// A leaf as a mesh of its own; vertices in one place are one.
struct LeafMesh {
    std::vector<uint32_t> vertices;  ///< of the model: the first in each place, ascending
    std::vector<glm::vec3> positions;
    std::vector<std::array<uint32_t, 3>> triangles;
    std::vector<uint32_t> sources;  ///< per triangle: of the split surface; behind its last one the
                                    ///< hidden faces
};

/// Of every leaf the numbers of its faces, as LeafMesh::sources has them, ascending.
std::vector<std::vector<uint32_t>> facesOfLeaves(const PieceModel& model);

/// places: per vertex of the model the first one in its place.
LeafMesh leafMesh(const PieceModel& model, const std::vector<uint32_t>& places,
                  const std::vector<uint32_t>& faces);

struct LeafCut {
    LeafMesh mesh;
    MeshCut cut;
    CutPieces pieces;
    uint32_t cells = 0;            ///< that there would be pieces of, were they all filled
    std::optional<Error> refusal;  ///< it stays whole; pieces are empty
    bool shared = false;           ///< the cells cut other leaves, too
    /// Per piece which cell it is of: leaves of one piece before the cut, with the same label, are
    /// one piece behind it. What is not divided has one label.
    std::vector<uint32_t> labels{0};

    bool divided() const { return pieces.pieces.size() > 1; }
};

/// grid: of the whole object, so that leaves are snapped alike.
LeafCut cutLeaf(LeafMesh mesh, const VolumeCut& cut, uint64_t seed, const CutGrid& grid);
/// The same by the prisms over a drawing.
LeafCut cutLeaf(LeafMesh mesh, const DrawnPrisms& prisms, const CutGrid& grid);

struct PieceCells;

/// By cells that cut other leaves, too. What is thinner than `thinnest` (metres) of a leaf becomes
/// part of its neighbour; a leaf that cannot be cut is of the cell that its middle is in.
LeafCut cutLeafByShared(LeafMesh mesh, const PieceCells& cells, double thinnest,
                        const CutGrid& grid);
/// The same by the prisms over a drawing.
LeafCut cutLeafByShared(LeafMesh mesh, const DrawnPrisms& prisms, double thinnest,
                        const CutGrid& grid);

}  // namespace sherd
