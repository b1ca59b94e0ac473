// SPDX-License-Identifier: MIT
// The inside of the object as patterns divide it: every leaf is what is nearest to its site, within
// what is nearest to the site of the level before.
#pragma once

#include <optional>
#include <vector>

#include "surface/cut_surface.h"

namespace sherd {

class CellSpace {
  public:
    /// Nothing unless the pieces of all levels are cells of sites.
    static std::optional<CellSpace> of(const CutSurface& cut, const Components& components);

    /// A plane by a unit normal: its value is the signed distance from it.
    struct Plane {
        glm::dvec3 normal{0.0};
        double offset = 0;
        double at(const glm::dvec3& p) const { return glm::dot(normal, p) + offset; }
    };

    /// What parts two leaves: negative where the first is, positive where the second. Nothing for
    /// leaves that no bisector parts.
    std::optional<Plane> between(uint32_t a, uint32_t b) const;

    uint32_t leafCount() const { return static_cast<uint32_t>(leaves_.size()); }

  private:
    struct Cell {
        uint32_t domain = 0;
        uint32_t number = 0;
    };
    std::vector<const CellSites*> levels_;
    std::vector<std::vector<Cell>> leaves_;  ///< per leaf, its cell at every level
};

}  // namespace sherd
