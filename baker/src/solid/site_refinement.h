// SPDX-License-Identifier: MIT
#pragma once

#include "solid/tetra_complex.h"
#include "surface/components.h"

namespace sherd {

/// More sites where several pieces come to a lump that cannot be shared out among them: smaller
/// cells are flatter. Empty if there is no such lump.
std::vector<glm::dvec3> sitesForMixedLumps(const TetraComplex& complex, const Components& pieces);

}  // namespace sherd
