// SPDX-License-Identifier: MIT
// Edges at which a piece touches itself are told apart by halving.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "volume/mesh_cut.h"
#include "volume/piece_builder.h"

namespace sherd {

/// A triangle of a cut: of the skin by its number, of caps by that and the skin's count.
using CutTriangleId = uint32_t;

/// A use of an edge: the triangles that meet there, one after the other, in however many pieces.
struct EdgeUse {
    uint32_t a, b;  ///< vertices of the cut
    std::vector<CutTriangleId> triangles;
};

/// For the clashes of pieces a use each to be halved, as far as these share no triangle: what is
/// left may clash again. Each piece has two of a use's triangles or none, so it stays closed.
std::vector<EdgeUse> clashingUses(const MeshCut& cut, const std::vector<BuiltPiece>& pieces);

/// Gives each use a vertex in the middle of its edge, its triangles two halves. No two uses share
/// a triangle.
void halveEdges(MeshCut& cut, std::span<const EdgeUse> uses);

}  // namespace sherd
