// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "appearance/hidden_mesh.h"
#include "geometry/triangle_bvh.h"

namespace sherd {

/// Per position of the mesh: its distance from the skin, metres. 0 for those on the skin and those
/// of no face.
std::vector<double> hiddenDepths(const HiddenMesh& mesh, const TriangleBvh& skin);

}  // namespace sherd
