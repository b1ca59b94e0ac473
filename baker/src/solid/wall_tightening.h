// SPDX-License-Identifier: MIT
#pragma once

#include "solid/inside_labels.h"

namespace sherd {

/// Evens out the walls between pieces: their vertices go to the middle of their neighbours as far
/// as no tetrahedron is turned over. The skin stays where it is.
void tightenWalls(const InsideLabels& labels, TetraComplex& complex);

}  // namespace sherd
