// SPDX-License-Identifier: MIT
// All lines of a bake, of whatever source, under one number each.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sherd/baker/fracture_map.h"

namespace sherd {

/// A line's **mark** is its place in the table plus 1; 0 stands for no line. The table is sorted by
/// level, so of two lines along one edge the lower mark is the coarser and wins.
class LineTable {
  public:
    struct Line {
        uint32_t level = 1;
        LineProperties properties;
        std::string source;  ///< for reports
        bool cells = false;  ///< a pattern: its cells, not its lines, are the pieces of its level
    };

    /// Takes the lines in the order of their sources; returns each one's mark. Levels that no line
    /// has are closed up; a pattern that shares its level with others divides what they leave, from
    /// a level of its own right behind.
    std::vector<uint32_t> assign(std::vector<Line> lines);

    const Line& line(uint32_t mark) const { return lines_[mark - 1]; }
    uint32_t level(uint32_t mark) const { return lines_[mark - 1].level; }
    /// What became of a level as it was asked for: how many levels up to it have lines.
    uint32_t closedUp(uint32_t asked) const;
    /// The level that was asked for where now is `level`, 1 to levels().
    uint32_t asked(uint32_t level) const { return asked_[level - 1]; }
    uint32_t size() const { return static_cast<uint32_t>(lines_.size()); }
    uint32_t levels() const { return lines_.empty() ? 0 : lines_.back().level; }

  private:
    std::vector<Line> lines_;
    std::vector<uint32_t> asked_;  ///< levels before they were closed up, ascending
};

}  // namespace sherd
