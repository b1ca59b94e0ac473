// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "appearance/hidden_mesh.h"

namespace sherd {

/// Per half edge 3 * face + k, from corner k to corner k + 1: the half edge of the face that goes
/// on beyond it in the same surface, or kNone. A surface is what one fragment shows at once: its
/// sheet, or the walls that a level gives it. So nothing ends where only a deeper level divides.
std::vector<uint32_t> hiddenOpposites(const HiddenMesh& mesh);

}  // namespace sherd
