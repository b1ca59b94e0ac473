// SPDX-License-Identifier: MIT
#include "surface/line_table.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace sherd {

std::vector<uint32_t> LineTable::assign(std::vector<Line> lines) {
    std::vector<uint32_t> order(lines.size());
    std::iota(order.begin(), order.end(), 0U);
    std::stable_sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
        return std::pair(lines[a].level, lines[a].cells) <
               std::pair(lines[b].level, lines[b].cells);
    });
    asked_.clear();
    for (uint32_t i = 0, last = 0, level = 0; i < order.size(); ++i) {
        LineTable::Line& line = lines[order[i]];
        if (line.level != last || line.cells) {
            ++level;
            asked_.push_back(line.level);
        }
        last = line.level;
        line.level = level;
    }
    std::vector<uint32_t> marks(lines.size());
    lines_.clear();
    lines_.reserve(lines.size());
    for (const uint32_t i : order) {
        lines_.push_back(std::move(lines[i]));
        marks[i] = static_cast<uint32_t>(lines_.size());
    }
    return marks;
}

uint32_t LineTable::closedUp(uint32_t asked) const {
    return static_cast<uint32_t>(std::upper_bound(asked_.begin(), asked_.end(), asked) -
                                 asked_.begin());
}

}  // namespace sherd
