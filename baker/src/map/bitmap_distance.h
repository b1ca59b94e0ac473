// SPDX-License-Identifier: MIT
#pragma once

#include "map/bitmap_ink.h"

namespace sherd {

/// The radius of the largest disc of ink around a texel's centre: the distance to the nearest
/// ground texel's centre, less half a texel. Beyond the picture nothing is known, so a line cut off
/// by its border keeps its width.
class InkRadius {
  public:
    explicit InkRadius(const Raster<uint8_t>& mask);

    /// Of a texel of ink. Takes time with the radius.
    double at(size_t index) const;

  private:
    Raster<uint16_t> column_;  ///< distance to the nearest ground in the same column; 0 on ground
};

}  // namespace sherd
