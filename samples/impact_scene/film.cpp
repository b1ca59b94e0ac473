// SPDX-License-Identifier: MIT
#include "film.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>

namespace sherd::samples {
namespace {

/// Substeps to take before each frame: normal speed, an eighth around the hit, then speeding up.
std::vector<uint32_t> timeline(const FilmOptions& options, float hitTime) {
    constexpr uint32_t kSlowFrames = 44;
    constexpr uint32_t kRampFrames = 12;
    const auto normal = options.substepsPerFrame;
    const uint32_t slow = std::max(1U, normal / 8);
    // Slow motion starts a moment early, so that the ball is seen to arrive.
    const auto before = static_cast<uint32_t>((hitTime - 0.025F) * float(options.framesPerSecond));
    std::vector<uint32_t> substeps(options.frames, normal);
    for (uint32_t i = 0; i < kSlowFrames + kRampFrames && before + i < options.frames; ++i) {
        substeps[before + i] =
            i < kSlowFrames ? slow : slow + (normal - slow) * (i - kSlowFrames) / kRampFrames;
    }
    return substeps;
}

/// Just before the hit, three moments of slow motion, and the end.
std::array<uint32_t, kStillsPerShot> stillFrames(const FilmOptions& options, float hitTime) {
    const auto hit = static_cast<uint32_t>((hitTime - 0.025F) * float(options.framesPerSecond));
    const uint32_t last = options.frames - 1;
    return {std::min(hit + 2, last), std::min(hit + 14, last), std::min(hit + 34, last),
            std::min(hit + 56, last), last};
}

/// From the side the ball comes from, turned by half towards the profile, and more from the
/// object's front (+z in glTF) than from its back; drifts slowly.
SceneFrame aim(const Stage& stage, float progress) {
    SceneFrame frame;
    const glm::vec3 size = stage.high - stage.low;
    const float across = std::hypot(size.x, size.z);
    const float reach = std::max(0.56F * size.y, 0.37F * across);
    const float distance = 1.35F * reach / std::tan(glm::radians(frame.fieldOfView / 2));
    const float angle = glm::radians(-52.0F + 14.0F * progress);
    glm::vec3 side = glm::cross(stage.from, glm::vec3(0, 1, 0));
    if (side.z > 0) side = -side;
    const glm::vec3 level = stage.from * std::cos(angle) + side * std::sin(angle);
    frame.target = stage.center() - glm::vec3(0, 0.10F * size.y, 0) - stage.from * (0.12F * size.y);
    frame.eye = frame.target + level * distance + glm::vec3(0, 0.24F * distance, 0);
    frame.sun = stage.from * 0.55F - side * 0.55F + glm::vec3(0, 0.9F, 0);
    frame.focus = stage.center();
    frame.focusRadius = 1.35F * stage.diagonal();
    frame.gridSize = std::exp2(std::round(std::log2(0.35F * stage.diagonal())));
    return frame;
}

}  // namespace

BallView makeBall(SceneRenderer& renderer) {
    constexpr uint32_t kRings = 24;
    constexpr uint32_t kSegments = 48;
    std::vector<RenderVertex> vertices;
    std::vector<uint32_t> indices;
    for (uint32_t ring = 0; ring <= kRings; ++ring) {
        for (uint32_t i = 0; i <= kSegments; ++i) {
            const float polar = std::numbers::pi_v<float> * float(ring) / kRings;
            const float angle = 2 * std::numbers::pi_v<float> * float(i) / kSegments;
            const glm::vec3 p(std::sin(polar) * std::cos(angle), std::cos(polar),
                              std::sin(polar) * std::sin(angle));
            vertices.push_back({p, p, {float(i) / kSegments, float(ring) / kRings}});
            if (ring == kRings || i == kSegments) continue;
            const uint32_t a = ring * (kSegments + 1) + i;
            const uint32_t b = a + kSegments + 1;
            indices.insert(indices.end(), {a, a + 1, b, a + 1, b + 1, b});
        }
    }
    BallView ball;
    ball.mesh = renderer.addMesh(vertices, indices);
    ball.material = renderer.addMaterial({{0.13F, 0.135F, 0.145F}, 0.38F, 0.6F, -1, 4.0F});
    ball.indexCount = static_cast<uint32_t>(indices.size());
    return ball;
}

Result<std::vector<Picture>> film(Shot& shot, const ModelView& model, const BallView& ball,
                                  SceneRenderer& renderer, VideoWriter* video,
                                  const FilmOptions& options, float hitTime) {
    const std::vector<uint32_t> substeps = timeline(options, hitTime);
    const std::array<uint32_t, kStillsPerShot> wanted = stillFrames(options, hitTime);
    const float dt = 1.0F / float(options.framesPerSecond * options.substepsPerFrame);
    std::vector<Picture> stills;
    for (uint32_t number = 0; number < options.frames; ++number) {
        for (uint32_t i = 0; i < substeps[number]; ++i) shot.step(dt);
        const auto repeats = std::count(wanted.begin(), wanted.end(), number);
        if (video == nullptr && repeats == 0) continue;
        SceneFrame frame = aim(shot.stage(), float(number) / float(options.frames));
        for (const FragmentPose& pose : shot.poses()) model.append(pose, frame.items);
        frame.items.push_back({ball.mesh, ball.material, 0, ball.indexCount, shot.ballMatrix()});
        const Picture picture = renderer.render(frame);
        for (ptrdiff_t i = 0; i < repeats; ++i)
            stills.push_back(shrink(picture, options.stillWidth));
        if (video == nullptr) continue;
        const Result<void> added = video->add(picture);
        if (!added) return tl::unexpected(added.error());
    }
    return stills;
}

}  // namespace sherd::samples
