// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>

#include "map/bitmap_distance.h"
#include "map/bitmap_ink.h"
#include "map/centre_graph.h"

namespace sherd {

/// The graph of a thinned drawing: one node for each end, each cluster of texels where more than
/// two lines meet and each lone texel; lines follow the texels between them. Spoils
/// `thinned`. Nothing if there would be more than `limit` lines.
std::optional<CentreGraph> traceLines(Raster<uint8_t>& thinned, const InkRadius& radius,
                                      size_t limit);

}  // namespace sherd
