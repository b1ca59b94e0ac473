// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "volume/cell_family.h"

namespace sherd {

/// How many of the planes on which functions are 0 meet in one point or line of the mesh's cube, or
/// come within 1e-6 of that. The order of their cells around it is a tie among 2^that many.
uint32_t mostMeeting(std::span<const LinearFunction> planes);

}  // namespace sherd
