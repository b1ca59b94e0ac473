// SPDX-License-Identifier: MIT
// Does a baked object look the same in pieces as it does whole?
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <vector>

#include "picture.h"
#include "scene_renderer.h"
#include "sherd/baker/import.h"
#include "sherd/runtime/asset.h"
#include "sherd/runtime/events.h"

namespace sherd::test {

/// A baked file: the ordinary mesh every viewer shows, read as a source model, and the pieces.
struct RestModel {
    Model source;
    std::shared_ptr<const Asset> asset;
};
Result<RestModel> loadRestModel(const std::filesystem::path& path);

/// Straight stretches of fracture lines in the world.
using LineSegments = std::vector<std::array<glm::vec3, 2>>;

/// The borders of each piece's outer surface, from the positions alone.
LineSegments fractureLines(const Asset& asset, const std::vector<FragmentPose>& pieces);

/// Triangles in the world, three places each.
std::vector<std::array<glm::vec3, 3>> sourceTriangles(const RestModel& model);

struct PixelGrid {
    uint32_t width = 0;
    uint32_t height = 0;
    glm::mat4 camera{1.0F};  ///< world to clip space
};

/// One flag per pixel, rows from the top: is its centre within a pixel of a line that can be seen
/// past the triangles?
std::vector<bool> nearLines(const PixelGrid& grid, const LineSegments& lines,
                            std::span<const std::array<glm::vec3, 3>> triangles);

struct LookDifference {
    uint32_t worst = 0;    ///< of 255, in any channel of any compared pixel
    glm::uvec2 at{0};      ///< where
    uint32_t pixels = 0;   ///< compared ones that are off by more than 3
    uint32_t skipped = 0;  ///< near lines
};
LookDifference comparePictures(const samples::Picture& whole, const samples::Picture& pieces,
                               const std::vector<bool>& skip);

}  // namespace sherd::test
