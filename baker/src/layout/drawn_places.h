// SPDX-License-Identifier: MIT
#pragma once

#include "layout/drawn_triangle.h"
#include "sherd/baker/report.h"

namespace sherd {

/// Takes places of reports, in the frame that lines are cut in, to where their triangles are drawn:
/// those in other tiles move onto the page with them.
class DrawnPlaces {
  public:
    /// nearness: how far a triangle may be from a place in 3D to be the one meant; metres.
    DrawnPlaces(const SurfaceMesh& mesh, double nearness);

    glm::dvec2 drawn(const BakePlace& place) const;  ///< Precondition: it has a UV

  private:
    struct Moved {
        uint32_t triangle;
        std::array<glm::dvec2, 3> placed;
        std::array<glm::vec2, 3> drawn;
    };

    const SurfaceMesh& mesh_;
    double nearness_;
    std::vector<Moved> moved_;
};

}  // namespace sherd
