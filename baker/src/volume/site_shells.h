// SPDX-License-Identifier: MIT
// Sites from near to far.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <utility>
#include <vector>

namespace sherd {

/// Sites in a grid of cubes, met shell by shell around one of them.
class SiteShells {
  public:
    explicit SiteShells(const std::vector<glm::dvec3>& sites);

    /// visit(l, distance) for the other sites, each shell's nearest first; a site met later may be
    /// nearer than one met before, but not nearer than `distance` said of a whole shell. Until
    /// `reach()`, asked before every shell, is below what is still to come.
    template <class Reach, class Visit>
    void around(uint32_t i, const Reach& reach, const Visit& visit) {
        for (int32_t shell = 0; nearestOf(shell) <= reach(); ++shell) {
            if (!collect(i, shell)) return;
            for (const auto& [distance, l] : shell_)
                if (distance <= reach()) visit(l);
        }
    }

  private:
    struct Cube {
        int32_t x, y, z;
    };
    Cube cubeOf(const glm::dvec3& p) const;
    /// No site of the shell is nearer than this to any place of the middle cube.
    double nearestOf(int32_t shell) const { return shell <= 1 ? 0 : (shell - 1) * side_; }
    /// Fills `shell_` with the sites of one shell of cubes; false beyond the last cube.
    bool collect(uint32_t i, int32_t shell);
    void addRow(uint32_t i, int32_t y, int32_t z, int32_t fromX, int32_t toX);

    const std::vector<glm::dvec3>& sites_;
    glm::dvec3 low_{0.0};
    double side_ = 1;
    Cube count_{1, 1, 1};
    std::vector<uint32_t> start_, ordered_;
    std::vector<std::pair<double, uint32_t>> shell_;
};

}  // namespace sherd
