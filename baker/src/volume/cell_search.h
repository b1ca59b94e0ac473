// SPDX-License-Identifier: MIT
// One cell at a time, cut out of the box by all the others that reach it.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "volume/cell_family.h"
#include "volume/convex_cell.h"
#include "volume/site_shells.h"

namespace sherd {

class CellSearch {
  public:
    CellSearch(const CellFunctions& functions, const CutBox& box);

    /// Cell i within the box, good until the next call.
    const ConvexCell& cell(uint32_t i);

  private:
    void cutBySites(uint32_t i);
    void cutByMembers(uint32_t i);
    void cutByOverlays(uint32_t i);
    bool mayReach(const LinearFunction& plane) const;
    bool cutBy(uint32_t i, uint32_t l);
    void measure();
    /// The members of family f, that of cell i left out, that its cell touches.
    std::vector<uint32_t> touching(uint32_t i, size_t f) const;

    const CellFunctions& functions_;
    CutBox box_;
    std::vector<glm::dvec3> sites_;  ///< as their family measures
    std::optional<SiteShells> shells_;
    ConvexCell cell_;
    glm::dvec3 low_{0.0}, high_{0.0};  ///< of the cell so far
};

}  // namespace sherd
