// SPDX-License-Identifier: MIT
#pragma once

#include "sherd/formats/fracture_set.h"

namespace sherd {

/// What a physics engine must know of an object `scale` times as large: all but its geometry.
FractureSet scaledBody(const FractureSet& set, float scale);

}  // namespace sherd
