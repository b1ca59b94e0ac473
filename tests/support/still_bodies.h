// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "sherd/runtime/island_world.h"

namespace sherd::test {

/// An engine in which nothing moves but what a test moves.
class StillBodies final : public BodyTable {
  public:
    void create(const IslandBody& body) override { take(body); }
    void update(const IslandBody& body) override { take(body); }
    void remove(uint32_t) override {}
    [[nodiscard]] BodyMotion motion(uint32_t island) const override { return motions[island]; }

    std::vector<BodyMotion> motions;  ///< per island
    std::vector<float> masses;

  private:
    void take(const IslandBody& body) {
        if (motions.size() <= body.island) {
            motions.resize(body.island + 1);
            masses.resize(body.island + 1);
        }
        motions[body.island] = body.motion;
        masses[body.island] = body.mass;
    }
};

}  // namespace sherd::test
