// SPDX-License-Identifier: MIT
#pragma once

#include "measures/protrusion.h"
#include "sherd/baker/report.h"
#include "sherd/formats/fracture_set.h"

namespace sherd {

/// Fills the measures of every level and fragment; those that take time only if a solid is given to
/// hold the pieces against. Needs the report's levels and fragments. The results do not depend on
/// the number of threads.
void measureSet(const FractureSet& set, const OriginalSolid* solid, unsigned threads,
                BakedObjectReport& report);

}  // namespace sherd
