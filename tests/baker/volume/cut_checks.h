// SPDX-License-Identifier: MIT
// What must hold of every cut, found without the code that cuts.
#pragma once

#include <string>
#include <vector>

#include "support/property.h"
#include "support/random_solids.h"
#include "volume/mesh_cut.h"
#include "volume/piece_mesh.h"

namespace sherd::test {

/// A solid in pieces, as they would be stored.
struct CutSolid {
    Solid whole;
    CutGrid grid;
    MeshCut cut;
    CutPieces pieces;
};

inline CutGrid gridOf(const Solid& solid) {
    return CutGrid::around(solid.positions, solid.triangles).value();
}

/// Cuts a solid; `wrong` says why it could not.
bool cutSolid(const Solid& whole, std::vector<CellFamily> families, CutSolid& result,
              std::string& wrong);

/// Each "" if all is well.
/// Over ids (also manifold) and over positions, with a volume.
std::string brokenClosed(const CutSolid& cut);
/// Caps: the low cell's piece and the high one's have the same triangles, bit by bit, turned round.
std::string brokenSharing(const CutSolid& cut);
std::string brokenVolume(const CutSolid& cut);
/// Every corner of skin is where its weights in its source say, and every vertex in its cell.
std::string brokenPlaces(const CutSolid& cut);
/// The parts of each source triangle have its area in sum and its direction.
std::string brokenSkin(const CutSolid& cut);
/// Random points: in the piece whose function is lowest there, as often as in the whole, and in no
/// other.
std::string brokenCoverage(const CutSolid& cut, Random& random, uint32_t points);

std::string whatBreaks(const CutSolid& cut, Random& random, uint32_t points);

}  // namespace sherd::test
