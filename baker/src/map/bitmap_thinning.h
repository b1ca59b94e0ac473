// SPDX-License-Identifier: MIT
#pragma once

#include "map/bitmap_ink.h"

namespace sherd {

/// Thins ink to 8-connected lines one texel wide, with the same components, holes and ends.
void thin(Raster<uint8_t>& mask);

/// The bit of ink in a mask, which neighbourhood() counts; others mark what a step knows of it.
inline constexpr uint8_t kInk = 1;

/// Neighbour k of `index` (Raster::step) is bit k.
inline uint8_t neighbourhood(const Raster<uint8_t>& mask, size_t index) {
    const uint8_t* at = &mask.values[index];
    const auto s = static_cast<ptrdiff_t>(mask.stride());
    return static_cast<uint8_t>((at[-s] & 1) | (at[1 - s] & 1) << 1 | (at[1] & 1) << 2 |
                                (at[1 + s] & 1) << 3 | (at[s] & 1) << 4 | (at[s - 1] & 1) << 5 |
                                (at[-1] & 1) << 6 | (at[-1 - s] & 1) << 7);
}

}  // namespace sherd
