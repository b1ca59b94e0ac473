// SPDX-License-Identifier: MIT
#pragma once

#include "appearance/hidden_mesh.h"
#include "sherd/baker/surface_mesh.h"
#include "surface/components.h"
#include "surface/split_surface.h"

namespace sherd {

/// An object in pieces, between two levels: what outer and hidden faces its leaves have. Vertices
/// are numbered as in the hidden mesh, those of the split surface first. A leaf's faces close over
/// their places.
struct PieceModel {
    const SurfaceMesh& mesh;
    SplitSurface& surface;
    Components& components;  ///< a leaf may have no outer face
    HiddenMesh& hidden;      ///< without caps of holes, which are outer faces here
};

/// Per vertex of the model the first one in its place.
std::vector<uint32_t> placesOf(const PieceModel& model);

}  // namespace sherd
