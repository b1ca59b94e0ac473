// SPDX-License-Identifier: MIT
// Patches that face each other across a wall and so are the two skins of one piece.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "solid/far_side.h"
#include "surface/components.h"

namespace sherd {

/// Per leaf the lowest of those that are one piece with it. Twins at a deeper level lie within
/// twins of the level before. drawn: whether the lines of a level, not cells of a pattern, say what
/// its pieces are; only then has it twins. Those farther apart than they are wide are no skins of a
/// wall, unless `far`: lines were carried from one side to the other.
std::vector<uint32_t> twinLeaves(const SplitSurface& surface, const MeshTopology& topology,
                                 const Components& components, const FarSide& farSide,
                                 const std::function<bool(uint32_t level)>& drawn, bool far);

/// Leaves of one group made one, and with them what they belong to at every level.
/// newLeaf: receives the number of every old leaf's new one.
Components uniteLeaves(const Components& components, std::span<const uint32_t> group,
                       std::vector<uint32_t>& newLeaf);

}  // namespace sherd
