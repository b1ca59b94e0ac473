// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "map/svg_curves.h"

namespace sherd {

struct SvgPath {
    std::vector<Outline> outlines;  ///< those with at least one piece
    std::string problem;            ///< why and where reading stopped; empty: it did not
};

/// A path's `d`. What stands before a mistake is kept, as SVG asks.
SvgPath parseSvgPath(std::string_view d);

/// The `points` of a polyline or polygon, with the same rule.
SvgPath parseSvgPoints(std::string_view points, bool closed);

}  // namespace sherd
