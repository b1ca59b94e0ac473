// SPDX-License-Identifier: MIT
// Which pieces of a level the next one divides.
#pragma once

#include <string>
#include <vector>

#include "levels/piece_model.h"
#include "sherd/baker/volume_cut.h"
#include "sherd/formats/result.h"

namespace sherd {

/// A component that a label gave a name, and with it all that it is divided into.
struct PieceName {
    uint32_t level, component;
    std::string name;
};

/// Per piece of the deepest level that there is whether it is chosen. faces: per piece those of its
/// leaves, as `facesOfLeaves` gives them; places of the choice are in the object's frame. Error
/// badArgument: none is; it says what pieces there are.
Result<std::vector<uint8_t>> choosePieces(const PieceChoice& choice, const PieceModel& model,
                                          const std::vector<PieceName>& names,
                                          const std::vector<std::vector<uint32_t>>& faces);

/// A choice with its places in the object's frame, not the scene's.
PieceChoice inObjectFrame(PieceChoice choice, const SurfaceMesh& mesh);

}  // namespace sherd
