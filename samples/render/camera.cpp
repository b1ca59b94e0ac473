// SPDX-License-Identifier: MIT
#include "camera.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <limits>

namespace sherd::samples {
namespace {

constexpr float kMargin = 1.06F;  ///< of the picture's half width around the places
constexpr float kFar = std::numeric_limits<float>::max();

/// Along one axis of the picture a place at (x, z) from a camera at (c, d) is seen when
/// |x - c| <= (d - z) slope, z and d counting towards the camera.
class Slab {
  public:
    explicit Slab(float slope) : slope_(slope) {}

    void add(float x, float z) {
        high_ = std::max(high_, x + z * slope_);
        low_ = std::min(low_, x - z * slope_);
    }

    [[nodiscard]] float distance() const { return (high_ - low_) / (2 * slope_); }
    [[nodiscard]] float middle() const { return (high_ + low_) / 2; }

  private:
    float slope_;
    float low_ = kFar;
    float high_ = -kFar;
};

}  // namespace

SceneFrame frameAround(std::span<const glm::vec3> places, const CameraOptions& options) {
    const float turn = glm::radians(options.turn);
    const float rise = glm::radians(options.elevation);
    const glm::vec3 back(std::sin(turn) * std::cos(rise), std::sin(rise),
                         std::cos(turn) * std::cos(rise));
    const glm::vec3 right = glm::normalize(glm::cross(glm::vec3(0, 1, 0), back));
    const glm::vec3 up = glm::cross(back, right);
    const float slope = std::tan(glm::radians(options.fieldOfView / 2)) / kMargin;
    Slab across(slope * options.aspect);
    Slab upright(slope);
    glm::vec3 low(kFar);
    glm::vec3 high(-kFar);
    for (const glm::vec3& p : places) {
        across.add(glm::dot(p, right), glm::dot(p, back));
        upright.add(glm::dot(p, up), glm::dot(p, back));
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    const float distance = std::max(across.distance(), upright.distance());
    SceneFrame frame;
    frame.fieldOfView = options.fieldOfView;
    frame.eye = right * across.middle() + up * upright.middle() + back * distance;
    frame.target = frame.eye - back;
    frame.sun = back * 0.7F - right * 0.75F + glm::vec3(0, 1.0F, 0);
    frame.focus = (low + high) * 0.5F;
    // Shadows are cast on the floor as well, beside the pieces.
    frame.focusRadius = 0.75F * glm::distance(low, high);
    frame.gridSize = std::exp2(std::round(std::log2(0.3F * glm::distance(low, high))));
    return frame;
}

}  // namespace sherd::samples
