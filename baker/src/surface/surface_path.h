// SPDX-License-Identifier: MIT
// Lines over the surface from point to point.
//
// A path follows the plane through both points that holds the mean of their normals (or, where
// these cancel, either): what an artist sees as straight, looking at the stroke. Geodesics were the
// other choice; they bend around what lies near but out of sight, need a global solve for every
// stroke, and their crossings of edges are roots, not ratios. The plane needs one number per vertex
// (its signed distance), so both sides of an edge see the same crossing and the walk from triangle
// to triangle cannot lose its way. Where the plane's curve does not lead from one point to the
// other, the path follows edges of the mesh instead (Dijkstra 1959), and says so.
#pragma once

#include <optional>
#include <vector>

#include "surface/chords.h"
#include "surface/split_surface.h"
#include "surface/surface_point.h"

namespace sherd {

struct SurfacePath {
    std::vector<Chord> chords;
    bool alongEdges = false;  ///< no plane led there
};

class PathTracer {
  public:
    PathTracer(const SplitSurface& surface, const MeshTopology& topology);

    /// Nothing where no way leads over the surface. line: mark of the chords.
    std::optional<SurfacePath> trace(const SurfacePoint& from, const SurfacePoint& to,
                                     uint32_t line) const;

  private:
    /// A point as each triangle around it sees it.
    struct Seen {
        uint32_t triangle;
        GridPoint frame;
    };
    using Star = std::vector<Seen>;

    Star starOf(const SurfacePoint& point) const;
    Star cornersAround(uint32_t corner) const;
    glm::dvec3 normalOf(const Star& star) const;
    glm::dvec3 position(uint32_t vertex) const;
    std::optional<SurfacePath> byPlane(const SurfacePoint& from, const Star& start, const Star& end,
                                       const glm::dvec3& target, uint32_t line) const;
    std::optional<SurfacePath> byEdges(const Star& start, const Star& end, uint32_t line) const;

    const SplitSurface& surface_;
    const MeshTopology& topology_;
    std::vector<uint32_t> cornerOfVertex_;
};

}  // namespace sherd
