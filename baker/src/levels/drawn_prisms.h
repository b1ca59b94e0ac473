// SPDX-License-Identifier: MIT
// A drawing projected straight through an object, for cutting it along.
#pragma once

#include <string>
#include <vector>

#include "levels/lines_off_faces.h"
#include "levels/piece_model.h"
#include "sherd/baker/volume_cut.h"
#include "volume/cut_grid.h"
#include "volume/prism_map.h"

namespace sherd {

struct DrawnPrisms {
    PrismMap map;
    uint32_t axis = 2;  ///< of the object
    std::vector<std::string> warnings;
    MovedLines moved;
};

/// The drawing of a cut of the kind `map` on the page that covers the object as it is seen along
/// the cut's axis. Errors: limitExceeded (a place too far from the page), internal.
Result<DrawnPrisms> drawnPrisms(const VolumeCut& cut, const PieceModel& model, const CutGrid& grid);

}  // namespace sherd
