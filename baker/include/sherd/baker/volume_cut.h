// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "sherd/formats/result.h"

namespace sherd {

/// How pieces are cut through their volume, each by cells of its own. Needs no texture coordinates
/// and no lines.
struct VolumeCut {
    enum class Kind : uint8_t {
        voronoi,  ///< everything nearer to one of `count` points inside than to the others
        grid,     ///< the same, of points on a cubic lattice, moved by `jitter`
        slices,   ///< slabs along the object's axes
        wood      ///< Voronoi cells drawn out along an axis: splinters
    };
    Kind kind = Kind::voronoi;
    uint32_t count = 12;  ///< voronoi, grid, wood: of cells in each piece, 1 to 10,000
    std::array<uint32_t, 3> slabs{2, 2, 2};  ///< slices: along x, y, z; 1 to 1,000 each
    uint32_t seed = 1;
    std::vector<glm::dvec3> around;  ///< voronoi: scene coordinates; cells crowd there
    double spread = 0.2;      ///< voronoi: how far the crowds reach, share of the piece's diagonal
    glm::dvec3 stretch{1.0};  ///< voronoi, grid: cells are that much longer along x, y, z; 1 to 64
    double jitter = 0.5;  ///< grid: 0 to 1 of half the distance of points; slices: of half that of
                          ///< planes, 0 unless it is said
    double tilt = 0;      ///< slices: 0 to 1, of 45 degrees
    uint32_t axis = 1;    ///< wood: x, y, z as 0, 1, 2
    double elongation = 8;  ///< wood: length of a splinter over its width; 1 to 64
    std::string text;       ///< as it was asked for, for reports
};

/// KIND:COUNTS[:SEED][:KEY=VALUE]...: "voronoi:12", "voronoi:50:7:around=0,1,0:spread=0.1",
/// "grid:30:jitter=0.3", "slices:4x3x2:1:jitter=0.4:tilt=0.1", "wood:20:3:axis=y:elongation=12".
/// Error badArgument says what is known and allowed.
Result<VolumeCut> parseVolumeCut(std::string_view text);

}  // namespace sherd
