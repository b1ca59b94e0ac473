// SPDX-License-Identifier: MIT
// A baked object on the graphics card: its buffers, and a material for each of its own.
#pragma once

#include <glm/mat4x4.hpp>
#include <memory>
#include <span>
#include <vector>

#include "scene_renderer.h"
#include "sherd/formats/gltf_document.h"
#include "sherd/runtime/asset.h"
#include "sherd/runtime/events.h"

namespace sherd::samples {

/// The document's materials of these glTF indices, -1 being the default one. Those without a
/// picture get a grain that suits an object of this diagonal: a plain colour looks like plastic.
std::vector<uint32_t> addMaterials(const GltfDocument& document, std::span<const int32_t> indices,
                                   float diagonal, SceneRenderer& renderer);

class ModelView {
  public:
    /// `document` is the baked file the asset came from: it holds the materials and images.
    ModelView(std::shared_ptr<const Asset> asset, const GltfDocument& document,
              SceneRenderer& renderer);

    /// What one piece shows, at its pose.
    void append(const FragmentPose& pose, std::vector<DrawItem>& items) const;

  private:
    std::shared_ptr<const Asset> asset_;
    uint32_t mesh_ = 0;
    std::vector<uint32_t> materials_;  ///< per FractureSet::materials
};

glm::mat4 toMatrix(const RigidPose& pose);

}  // namespace sherd::samples
