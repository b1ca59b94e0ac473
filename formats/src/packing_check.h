// SPDX-License-Identifier: MIT
#pragma once

#include "sherd/formats/fracture_set.h"
#include "sherd/formats/result.h"

namespace sherd {

/// Of a set that was put on a grid and read back: no fragment has more open edges than it had, and
/// none has lost its volume. `notClosed`, with the fragment and what to do.
Result<void> checkPacked(const FractureSet& before, const FractureSet& after);

}  // namespace sherd
