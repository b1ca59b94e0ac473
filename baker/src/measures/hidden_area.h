// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "measures/shown_triangles.h"

namespace sherd {

struct FragmentArea {
    double whole = 0;   ///< square metres, of all that the fragment shows
    double hidden = 0;  ///< of it: what shows only since the object broke
};

/// Per fragment.
std::vector<FragmentArea> fragmentAreas(const ShownTriangles& shown);

}  // namespace sherd
