// SPDX-License-Identifier: MIT
// The interior "solid" (thesis 6.3.2): which leaves can be closed straight through the solid, and
// how.
#pragma once

#include "interior/stitching.h"
#include "surface/cut_surface.h"

namespace sherd {

/// Every leaf that it names is closed and positive, together with the solid leaves of its fragment
/// at every level. All others are left to the sheet. The two skins of a wall, where lines part them
/// alike, become one leaf, as far as that is solid. carried: lines were carried across. mayDivide:
/// the triangles of the surface may be divided further where that helps.
SolidLeaves findSolidLeaves(CutSurface& cut, bool carried, bool mayDivide, Components& components);

}  // namespace sherd
