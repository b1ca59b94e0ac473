// SPDX-License-Identifier: MIT
#pragma once

#include <glm/vec2.hpp>
#include <span>

#include "sherd/baker/surface_mesh.h"

namespace sherd {

/// The upper left end of a box of that extent (page units) on the page, where it covers the least
/// of the charts; of equal places the one nearest to a corner of the page.
glm::dvec2 freePlace(std::span<const SurfaceMesh> meshes, const glm::dvec2& extent);

}  // namespace sherd
