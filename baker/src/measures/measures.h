// SPDX-License-Identifier: MIT
#pragma once

#include "measures/protrusion.h"
#include "sherd/baker/report.h"
#include "sherd/formats/fracture_set.h"

namespace sherd {

/// Fills the measures of every level and fragment; `all` asks for those that take time, too. Needs
/// the report's levels and fragments. The results do not depend on the number of threads.
void measureSet(const FractureSet& set, const OriginalSolid& solid, bool all, unsigned threads,
                BakedObjectReport& report);

}  // namespace sherd
