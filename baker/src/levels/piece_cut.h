// SPDX-License-Identifier: MIT
// The pieces of a level, cut one by one, each by cells of its own.
//
// Where levels of lines come below the cut, a piece consists of several leaves, which these lines
// have parted already. All of them are cut by the cells of their sum, so that what is between two
// of them is cut alike on both sides.
#pragma once

#include <vector>

#include "levels/leaf_cut.h"
#include "levels/piece_choice.h"

namespace sherd {

struct PieceCut {
    std::vector<uint32_t> leaves;  ///< ascending
    /// Of several leaves; one alone has these in its own cut.
    uint32_t cells = 0;
    uint32_t movedPlanes = 0, opposedPlanes = 0;
    std::optional<Error> refusal;  ///< there are no cells; its leaves have no cut

    bool isShared() const { return leaves.size() > 1; }
};

struct PieceCuts {
    std::vector<PieceCut> pieces;
    std::vector<LeafCut> leaves;  ///< per leaf; see `LeafCut::labels`
};

/// The leaves of each piece of the deepest level that there is.
std::vector<std::vector<uint32_t>> leavesOfPieces(const Components& components);

/// cut: in the object's frame; prisms: those of its drawing, if it has one. The result does not
/// depend on the number of threads. Error badArgument: nothing is chosen.
Result<PieceCuts> cutPieces(const VolumeCut& cut, const DrawnPrisms* prisms, unsigned threads,
                            const std::vector<PieceName>& names, const CutGrid& grid,
                            const PieceModel& model);

}  // namespace sherd
