// SPDX-License-Identifier: MIT
// One piece of a cut, and how its triangles meet.
#pragma once

#include <cstdint>
#include <vector>

#include "volume/mesh_cut.h"
#include "volume/piece_mesh.h"

namespace sherd {

struct BuiltPiece {
    PieceMesh mesh;
    std::vector<uint32_t> twins;    ///< per half edge; see `EdgePairs`
    std::vector<uint32_t> clashes;  ///< half edges of edges still used more than once, all but one
};

class PieceBuilder {
  public:
    /// groupOf: per cell.
    PieceBuilder(const MeshCut& cut, std::vector<uint32_t> groupOf);

    BuiltPiece build(const std::vector<uint32_t>& cells);

  private:
    void addCap(uint32_t cap, uint32_t cell);
    void add(const std::array<uint32_t, 3>& t, PieceMesh::Origin origin, uint64_t sheet);
    uint64_t sheetOf(const MeshCut::SkinTriangle& t) const;
    void separateFans();
    void findClashes(std::vector<uint32_t> repeated);

    const MeshCut& cut_;
    std::vector<uint32_t> groupOf_;
    std::vector<std::vector<uint32_t>> capsOf_;  ///< per cell, those to other groups
    std::vector<uint32_t> local_;                ///< per vertex of the cut
    BuiltPiece piece_;
    std::vector<uint64_t> sheets_;  ///< per triangle: see `PairingInput`
};

}  // namespace sherd
