// SPDX-License-Identifier: MIT
// In which order the levels of a bake stand, those of lines and those that cut through the volume.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sherd/baker/fracture_plan.h"
#include "surface/line_table.h"

namespace sherd {

struct OrderedLevel {
    uint32_t drawn = 0;                 ///< of lines: their level in the line table; 0: a cut
    const VolumeCut* cut = nullptr;     ///< of the plan, unless it is a level of lines
    const PieceChoice* only = nullptr;  ///< which pieces lines divide; null: all
    std::string where;                  ///< of lines: their pointer in a recipe; may be empty
    uint32_t asked = 0;  ///< its level in the plan; of cuts behind all lines more than any
};

/// Coarse to fine. The plan must outlive it.
class LevelOrder {
  public:
    LevelOrder() = default;
    LevelOrder(const FracturePlan& plan, const LineTable& lines);

    const std::vector<OrderedLevel>& levels() const { return levels_; }
    /// Levels of lines before any that cuts or chooses, for which pieces must be known.
    uint32_t plainLevels() const;
    /// How many levels are coarser than a cluster.
    uint32_t above(const FracturePlan::Grouped& group) const;
    /// The level, from 1, that lines of a level of the table make; 0 for 0.
    uint32_t ofDrawn(uint32_t drawn) const;
    /// The level that a label means, by its own level: the last one asked for up to there; for 0
    /// the deepest of lines.
    uint32_t ofLabel(uint32_t asked) const;

  private:
    std::vector<OrderedLevel> levels_;
};

}  // namespace sherd
