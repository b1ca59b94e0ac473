// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sherd/baker/fracture_map.h"
#include "sherd/formats/result.h"

namespace sherd {

/// Which pieces of the level before a cut divides; the others stand for themselves. All that is
/// said must hold.
struct PieceChoice {
    double larger = 0;             ///< at least so large: share of the object's volume, 0 to 1
    double smaller = 1;            ///< at most
    std::vector<glm::dvec3> near;  ///< scene coordinates; within that of one of these
    double within = 0;             ///< metres from the point to the piece, 0: it is inside
    std::string name;  ///< of the piece, or of one it is part of, as a label of the drawings says

    bool all() const { return larger <= 0 && smaller >= 1 && near.empty() && name.empty(); }
};

/// How pieces are cut through their volume, each by cells of its own. Needs no texture coordinates
/// and no lines.
struct VolumeCut {
    enum class Kind : uint8_t {
        voronoi,  ///< everything nearer to one of `count` points inside than to the others
        grid,     ///< the same, of points on a cubic lattice, moved by `jitter`
        slices,   ///< slabs along the object's axes
        wood,     ///< Voronoi cells drawn out along an axis: splinters
        points,   ///< everything nearer to one of the points said than to the others
        bricks,   ///< rows along y, of bricks along x or z; every other row is shifted by half one
        glass,    ///< straight through along an axis: sectors and rings around a centre
        map       ///< straight through along an axis: by a drawing's lines
    };
    Kind kind = Kind::voronoi;
    uint32_t count = 12;  ///< voronoi, grid, wood: of cells in each piece, 1 to 10,000
    std::array<uint32_t, 3> slabs{2, 2, 2};  ///< slices: along x, y, z; bricks: in a row, rows,
                                             ///< deep; glass: sectors, rings; 1 to 1,000 each
    uint32_t seed = 1;
    std::vector<glm::dvec3> around;  ///< voronoi: scene coordinates; cells crowd there
    double spread = 0.2;      ///< voronoi: how far the crowds reach, share of the piece's diagonal
    glm::dvec3 stretch{1.0};  ///< voronoi, grid: cells are that much longer along x, y, z; 1 to 64
    double jitter = 0.5;  ///< grid, glass: 0 to 1 of half the distance of points; slices, bricks:
                          ///< of half that of planes, 0 unless it is said
    std::vector<glm::dvec3> points;    ///< points: scene coordinates
    std::optional<glm::dvec3> centre;  ///< glass: scene coordinates; else the piece's middle
    double tilt = 0;                   ///< slices: 0 to 1, of 45 degrees
    /// wood: along the grain; glass: looked along; bricks: of a brick's length. x, y, z of the
    /// object as 0, 1, 2. Else wood: y; glass: the piece's shortest side; bricks: the longer of x
    /// and z.
    std::optional<uint32_t> axis;
    std::filesystem::path map;  ///< map: the drawing, relative to the recipe; see `drawing`
    std::shared_ptr<const FractureMap> drawing = {};  ///< map: what it names, whatever its levels
    /// map: the axis of the object that is looked along, the page upright as `Projection` has it;
    /// the page covers the object. 0: onto its largest side.
    glm::dvec3 along{0.0};
    double elongation = 8;  ///< wood: length of a splinter over its width; 1 to 64
    PieceChoice only;
    std::string text;   ///< as it was asked for, for reports
    std::string where;  ///< its pointer in a recipe, for messages; may be empty
};

/// KIND:COUNTS[:SEED][:KEY=VALUE]...: "voronoi:12", "voronoi:50:7:around=0,1,0:spread=0.1",
/// "grid:30:jitter=0.3", "slices:4x3x2:1:jitter=0.4:tilt=0.1", "wood:20:3:axis=y:elongation=12",
/// "points:0,0,0;0,1,0", "bricks:6x10x1", "glass:12x4:2:at=0,1,0", "voronoi:6:larger=0.02",
/// "map:cracks.svg:axis=-z", where the path goes on to the keys and may have colons.
/// Error badArgument says what is known and allowed.
Result<VolumeCut> parseVolumeCut(std::string_view text);

}  // namespace sherd
