// SPDX-License-Identifier: MIT
// A cell cut out of a box by one plane after another, its topology decided exactly.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <utility>
#include <vector>

#include "volume/plane_corner.h"

namespace sherd {

/// A box of grid points.
struct CutBox {
    CutGridPoint low, high;
};

class ConvexCell {
  public:
    struct Corner {
        std::array<uint32_t, 3> planes;  ///< into `planes`
        glm::dvec3 position;             ///< off by less than 2^-25 of a step per axis
    };
    struct Face {
        uint32_t plane = 0;          ///< into `planes`
        std::vector<uint32_t> loop;  ///< corners, counter-clockwise seen from outside
    };

    /// The whole box as cell i.
    void start(uint32_t i, const CutBox& box);

    /// Keeps where f is above the cell's own function: `plane` is the difference, `l` its index.
    /// Whether anything was cut away.
    bool clip(const LinearFunction& plane, uint32_t l);

    bool empty() const { return faces_.empty(); }
    const std::vector<BoundingPlane>& planes() const { return planes_; }
    const std::vector<Corner>& corners() const { return corners_; }  ///< some may be out of use
    const std::vector<Face>& faces() const { return faces_; }
    /// The corners that faces use.
    const std::vector<uint32_t>& usedCorners() const { return used_; }

  private:
    struct NewCorner {
        std::pair<uint32_t, uint32_t> edge;  ///< the two planes of the edge it cuts, lower first
        uint32_t corner;
    };
    int sideOf(const Corner& corner, const BoundingPlane& plane) const;
    uint32_t cornerOnEdge(uint32_t a, uint32_t b, uint32_t face);
    void clipFace(Face& face);
    void closeFace();

    uint32_t cell_ = 0;
    std::vector<BoundingPlane> planes_;
    std::vector<Corner> corners_;
    std::vector<Face> faces_;
    std::vector<uint32_t> used_;
    std::vector<uint8_t> kept_;  ///< per corner, by the clip in progress
    std::vector<NewCorner> made_;
    std::vector<std::pair<uint32_t, uint32_t>> rim_;  ///< of the new face: directed edges
    std::vector<uint32_t> loop_;
};

}  // namespace sherd
