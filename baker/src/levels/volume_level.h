// SPDX-License-Identifier: MIT
// A level that cuts the pieces of the level before through their volume.
#pragma once

#include "levels/piece_choice.h"
#include "levels/piece_model.h"
#include "sherd/baker/report.h"
#include "sherd/baker/volume_cut.h"
#include "sherd/formats/result.h"

namespace sherd {

/// Divides the pieces that the cut chooses and adds a level for what they became; others stand for
/// themselves, those that cannot be divided with a finding. Returns per leaf as they are now which
/// it was part of; the result does not depend on the number of threads. Errors: separatesNothing,
/// limitExceeded, notClosed, badArgument (nothing is chosen), and why the first piece cannot be cut
/// if none can.
Result<std::vector<uint32_t>> cutLevel(const VolumeCut& cut, unsigned threads,
                                       const std::vector<PieceName>& names, const PieceModel& model,
                                       BakedObjectReport& report);

}  // namespace sherd
