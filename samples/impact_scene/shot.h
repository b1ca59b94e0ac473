// SPDX-License-Identifier: MIT
// One object on a floor, and a ball thrown at it.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <vector>

#include "sherd/formats/result.h"
#include "sherd/runtime/asset.h"
#include "sherd/runtime/events.h"

namespace sherd::samples {

struct ShotOptions {
    float hitTime = 0.5F;      ///< s after the start
    float ballSize = 0.05F;    ///< radius, as a share of the object's diagonal
    float ballDensity = 7800;  ///< kg/m^3: iron
    float speed = 0;           ///< m/s at the hit; 0: from the object's size
};

/// Measures of the object as it stands, metres.
struct Stage {
    glm::vec3 low{0.0F};
    glm::vec3 high{0.0F};
    glm::vec3 from{1.0F, 0.0F, 0.0F};  ///< unit, horizontal: whence the ball comes
    glm::vec3 hit{0.0F};               ///< where it should meet the object

    [[nodiscard]] glm::vec3 center() const { return (low + high) * 0.5F; }
    [[nodiscard]] float diagonal() const;
};

class Shot {
  public:
    static Result<std::unique_ptr<Shot>> create(const std::shared_ptr<const Asset>& asset,
                                                const ShotOptions& options);
    ~Shot();
    Shot(const Shot&) = delete;
    Shot& operator=(const Shot&) = delete;

    /// One substep of `dt` seconds.
    void step(float dt);

    [[nodiscard]] const Stage& stage() const;
    [[nodiscard]] std::span<const FragmentPose> poses() const;    ///< valid until the next step
    [[nodiscard]] const std::vector<BreakEvent>& breaks() const;  ///< all so far
    [[nodiscard]] glm::mat4 ballMatrix() const;                   ///< of a ball of radius 1
    [[nodiscard]] float ballEnergy() const;                       ///< J, at the hit

  private:
    class Impl;
    explicit Shot(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

}  // namespace sherd::samples
