// SPDX-License-Identifier: MIT
// A small forward renderer for the samples: sun with a soft shadow, sky light, a floor.
#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <vector>

#include "picture.h"
#include "sherd/formats/result.h"

namespace sherd::samples {

struct RenderVertex {
    glm::vec3 position{0.0F};
    glm::vec3 normal{0.0F, 1.0F, 0.0F};
    glm::vec2 uv{0.0F};
};

struct RenderMaterial {
    glm::vec3 color{1.0F};  ///< linear
    float roughness = 0.8F;
    float metallic = 0;
    int32_t texture = -1;  ///< from addTexture
    float grain = 0;       ///< > 0: speckled, with features of 1 / grain metres
};

/// A run of a mesh's indices, placed.
struct DrawItem {
    uint32_t mesh = 0;
    uint32_t material = 0;
    uint32_t firstIndex = 0;
    uint32_t indexCount = 0;
    glm::mat4 model{1.0F};
};

struct SceneFrame {
    glm::vec3 eye{0.0F, 1.0F, 3.0F};
    glm::vec3 target{0.0F};
    float fieldOfView = 32;           ///< degrees, vertical
    glm::vec3 sun{0.4F, 0.8F, 0.4F};  ///< towards the sun
    glm::vec3 focus{0.0F};            ///< the middle of what shadows must cover
    float focusRadius = 1;            ///< metres
    bool floor = true;                ///< at y = 0
    float gridSize = 0.25F;           ///< metres between the floor's lines
    std::vector<DrawItem> items;
};

struct RendererOptions {
    uint32_t width = 640;        ///< pixels
    uint32_t height = 360;       ///< pixels
    uint32_t shadowSize = 1024;  ///< texels across the shadow map
    /// Samples per pixel and axis. At 1, edges are smoothed by a cheap filter that looks a few
    /// pixels around; above, a pixel is the mean of its own samples and of nothing else.
    uint32_t samples = 1;
};

/// From the world to clip space, for pictures of `aspect` (width / height).
glm::mat4 viewProjection(const SceneFrame& frame, float aspect);

/// Draws into a framebuffer object of the current OpenGL 3.3 context, which must outlive it.
class SceneRenderer {
  public:
    static Result<std::unique_ptr<SceneRenderer>> create(const RendererOptions& options);
    ~SceneRenderer();
    SceneRenderer(const SceneRenderer&) = delete;
    SceneRenderer& operator=(const SceneRenderer&) = delete;

    uint32_t addMesh(std::span<const RenderVertex> vertices, std::span<const uint32_t> indices);
    int32_t addTexture(const Picture& picture);
    uint32_t addMaterial(const RenderMaterial& material);

    Picture render(const SceneFrame& frame);

  private:
    class Impl;
    explicit SceneRenderer(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

}  // namespace sherd::samples
