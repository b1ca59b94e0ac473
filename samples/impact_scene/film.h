// SPDX-License-Identifier: MIT
// Films a shot: camera, slow motion around the hit, stills for the contact sheet.
#pragma once

#include <vector>

#include "model_view.h"
#include "picture.h"
#include "scene_renderer.h"
#include "shot.h"
#include "video_writer.h"

namespace sherd::samples {

/// A ball of radius 1, in a renderer.
struct BallView {
    uint32_t mesh = 0;
    uint32_t material = 0;
    uint32_t indexCount = 0;
};
BallView makeBall(SceneRenderer& renderer);

struct FilmOptions {
    uint32_t frames = 120;  ///< per shot
    uint32_t framesPerSecond = 30;
    uint32_t substepsPerFrame = 16;  ///< at normal speed
    uint32_t stillWidth = 316;       ///< pixels
};

inline constexpr uint32_t kStillsPerShot = 5;

/// Runs the shot to its end. `video` may be null. Returns the stills.
Result<std::vector<Picture>> film(Shot& shot, const ModelView& model, const BallView& ball,
                                  SceneRenderer& renderer, VideoWriter* video,
                                  const FilmOptions& options, float hitTime);

}  // namespace sherd::samples
