// SPDX-License-Identifier: MIT
#pragma once

#include "map/bitmap_ink.h"

namespace sherd {

/// For every texel of ink, the radius of the largest disc of ink around its centre (distance to the
/// nearest ground texel's centre, less half a texel); 0 on ground. Beyond the picture nothing is
/// known, so a line cut off by its border keeps its width.
Raster<float> inkRadius(const Raster<uint8_t>& mask);

}  // namespace sherd
