// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "map/planar_map.h"

namespace sherd {

/// Calls `visit(i, j)`, i < j, for every pair of segments (a support's a..b) that may touch; a pair
/// may come more than once. Stops when `visit` returns false, and says so by returning false.
bool forEachNearPair(std::span<const Support> segments,
                     const std::function<bool(uint32_t, uint32_t)>& visit);

}  // namespace sherd
