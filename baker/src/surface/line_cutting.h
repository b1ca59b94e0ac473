// SPDX-License-Identifier: MIT
// Lines that run over the surface, cut into it.
#pragma once

#include "surface/cutting_surface.h"

namespace sherd {

/// All lines in one cut; marks: one per line. What lies off the surface or leads nowhere is noted
/// in the result.
Result<void> cutSurfaceLines(CuttingSurface& work,
                             std::span<const FractureMap::SurfaceLine* const> lines,
                             std::span<const uint32_t> marks);

}  // namespace sherd
