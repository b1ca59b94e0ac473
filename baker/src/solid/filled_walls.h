// SPDX-License-Identifier: MIT
// Walls through a solid of any shape: it is filled with tetrahedra that fit its split surface, each
// goes to a piece, and walls are where two of different pieces meet. So pieces fill it exactly,
// whatever its shape and wherever lines run.
#pragma once

#include <optional>

#include "solid/solid_walls.h"
#include "solid/tetra_complex.h"
#include "surface/components.h"

namespace sherd {

struct FilledWalls {
    DividedSurface divided;  ///< with more vertices on lines; corners of walls are of it
    SolidWalls walls;
};

/// pieces: of the surface. Nothing where the solid cannot be filled.
std::optional<FilledWalls> filledWalls(const SplitSurface& surface, const Components& pieces);

}  // namespace sherd
