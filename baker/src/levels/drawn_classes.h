// SPDX-License-Identifier: MIT
// Which leaves of a drawing hang together where some of its levels do not cut.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "surface/components.h"
#include "surface/cut_surface.h"

namespace sherd {

class DrawnClasses {
  public:
    /// drawn: the leaves of all levels of lines, as they are closed. Keeps a copy.
    DrawnClasses(const CutSurface& cut, const Components& drawn);

    /// Per leaf of the drawing a label: those that lines of levels 1 to `level` leave together, but
    /// for those of skipped levels. Level 0: connected parts of the surface. A pattern's cells that
    /// were grown within pieces of a skipped level go on over its lines.
    const std::vector<uint32_t>& at(uint32_t level, const std::set<uint32_t>& skipped);

  private:
    struct Gate {
        uint32_t a, b;  ///< leaves, a < b
        uint32_t level;
        bool operator<(const Gate& o) const {
            return std::tie(a, b, level) < std::tie(o.a, o.b, o.level);
        }
    };
    std::vector<uint32_t> openGates(std::vector<uint32_t> labels,
                                    const std::set<uint32_t>* levels) const;

    Components drawn_;
    std::set<Gate> gates_;  ///< borders between leaves
    std::map<std::pair<uint32_t, std::set<uint32_t>>, std::vector<uint32_t>> known_;
};

}  // namespace sherd
