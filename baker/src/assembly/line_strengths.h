// SPDX-License-Identifier: MIT
// What lines say of the bonds between the leaves on their two sides.
#pragma once

#include <map>
#include <utility>

#include "assembly/hierarchy.h"
#include "surface/line_table.h"
#include "surface/split_surface.h"

namespace sherd {

/// Along the border of two leaves: how much of it says something, and the sum of what it says.
struct BorderStrength {
    double length = 0;                          ///< metres of border
    double strengthLength = 0, strength = 0;    ///< metres that say a strength; Pa times metres
    double toughnessLength = 0, toughness = 0;  ///< likewise, J/m^2

    /// The mean along the border; stretches that say nothing count `otherwise`.
    double strengthOr(double otherwise) const;
    double toughnessOr(double otherwise) const;
};

/// By the two leaves' fragments, the lower first. Borders of which no line says anything are left
/// out.
using BorderStrengths = std::map<std::pair<uint32_t, uint32_t>, BorderStrength>;

BorderStrengths lineStrengths(const SplitSurface& surface, const MeshTopology& topology,
                              const LineTable& lines, const Components& components,
                              const Hierarchy& hierarchy);

}  // namespace sherd
