// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "sherd/runtime/island_world.h"

namespace sherd {

/// Lets pieces that came off fade and go. Looks at some in every substep, in turn, so that the cost
/// of a step stays bounded.
class Debris {
  public:
    explicit Debris(DebrisOptions options) : options_(std::move(options)) {}

    void setViewer(const glm::vec3& position) { viewer_ = position; }
    /// After a substep.
    void step(IslandWorld& islands);

  private:
    [[nodiscard]] bool mayFade(IslandWorld& islands, uint32_t island) const;

    DebrisOptions options_;
    std::optional<glm::vec3> viewer_;
    uint32_t next_ = 0;
};

}  // namespace sherd
