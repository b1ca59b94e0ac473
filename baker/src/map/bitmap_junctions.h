// SPDX-License-Identifier: MIT
#pragma once

#include "map/bitmap_refine.h"
#include "map/centre_graph.h"

namespace sherd {

/// Makes one node of those that the width of the drawn lines has torn apart: whose discs of ink
/// overlap along the line between them, or nearly so and all lines point to one place.
void mergeJunctions(CentreGraph& graph);

/// Removes what thinning leaves in the tip of a sharp corner: loose lines that reach no more than
/// `spur` texels beyond where the other two lines at their junction meet.
void removeCornerTips(CentreGraph& graph, double spur);

/// Puts every junction where the lines that meet there point to, and runs them straight into it:
/// within the ink they share, centre lines keep to the middle of all of it.
void placeJunctions(CentreGraph& graph);

/// Puts corners of lines where their two sides point to, likewise; returns their indices among the
/// line's points, ascending. A closed line may start elsewhere afterwards.
std::vector<size_t> sharpenCorners(CentreLine& line, const InkField& field);

}  // namespace sherd
