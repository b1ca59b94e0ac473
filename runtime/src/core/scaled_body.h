// SPDX-License-Identifier: MIT
#pragma once

#include "sherd/formats/fracture_set.h"

namespace sherd {

/// What a physics engine must know of an object `scale` times as large and `density` times as
/// dense: all but its geometry.
FractureSet scaledBody(const FractureSet& set, float scale, float density);

}  // namespace sherd
