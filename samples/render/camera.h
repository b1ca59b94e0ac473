// SPDX-License-Identifier: MIT
#pragma once

#include <glm/vec3.hpp>
#include <span>

#include "scene_renderer.h"

namespace sherd::samples {

struct CameraOptions {
    float turn = 30;         ///< degrees around the object; 0 looks along -z
    float elevation = 14;    ///< degrees above the horizon
    float fieldOfView = 24;  ///< degrees, vertical
    float aspect = 1;        ///< width / height of the picture
};

/// As near as it can be with every place in the picture, and a thin margin. The sun comes from the
/// upper left, over the camera's shoulder.
SceneFrame frameAround(std::span<const glm::vec3> places, const CameraOptions& options);

}  // namespace sherd::samples
