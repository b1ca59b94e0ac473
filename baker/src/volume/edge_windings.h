// SPDX-License-Identifier: MIT
// Which stretches of the edges between cells are inside the mesh.
//
// The box around the mesh is outside. From its vertices the winding number is carried along the
// edges of the cells: each triangle crossed adds or takes one. Only the order of crossings along an
// edge and their signs count, both exact; no ray is cast.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "volume/cell_complex.h"
#include "volume/cut_vertex.h"

namespace sherd {

/// Where an edge of the cells meets a triangle.
struct EdgeCrossing {
    uint32_t edge;    ///< of the complex
    uint32_t vertex;  ///< of the cut
    int leaves;       ///< 1: going along the edge leaves the solid here, -1: enters it
};

/// A stretch between neighbouring crossings or ends of an edge.
struct InnerStretch {
    uint32_t edge;
    uint32_t from, to;  ///< vertices of the cut
    int winding;        ///< not 0
};

/// Nothing if the crossings contradict each other: those of a closed mesh do not.
std::optional<std::vector<InnerStretch>> innerStretches(const CellComplex& complex,
                                                        std::vector<EdgeCrossing> crossings,
                                                        CutVertices& vertices);

}  // namespace sherd
