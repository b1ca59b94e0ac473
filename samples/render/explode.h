// SPDX-License-Identifier: MIT
// Exploded views: the pieces of a level moved away from the object's middle.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "sherd/runtime/asset.h"
#include "sherd/runtime/events.h"

namespace sherd::samples {

/// The pieces of `level`, each moved by about `factor` times the way from the object's centre of
/// mass to the centre of its level-1 piece, then by two thirds of that within the piece: pieces
/// that broke off together stay together. 0 leaves the object as it rests in its scene.
std::vector<FragmentPose> pullApart(const Asset& asset, uint32_t level, float factor);

/// Every place the pieces show, in the world; places used by several triangles repeat.
std::vector<glm::vec3> shownPlaces(const Asset& asset, const std::vector<FragmentPose>& pieces);

/// Moves the pieces together, so that the lowest stands on the floor at the origin.
void setDown(const Asset& asset, std::vector<FragmentPose>& pieces);

}  // namespace sherd::samples
