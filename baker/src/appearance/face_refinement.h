// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "appearance/hidden_mesh.h"

namespace sherd {

/// Divides edges of hidden faces into parts of at most `longest` metres, every edge in all faces
/// around it alike, and fills broad faces with points: so faces that were each other's reverse stay
/// so. Edges of the outer surface stay whole. Where that would make more than about `mostFaces`,
/// parts are longer; returns their length.
double refineFaces(const SplitSurface& surface, double longest, size_t mostFaces, HiddenMesh& mesh);

}  // namespace sherd
