// SPDX-License-Identifier: MIT
// Faces between cells made fit to be shared out among pieces.
#pragma once

#include "volume/mesh_cut.h"

namespace sherd {

/// Divides triangles of caps so that each touches the skin in one edge of it or in one vertex at
/// most: then it can take the piece that lies there, without a say in what lies elsewhere.
void refineCaps(MeshCut& cut);

}  // namespace sherd
