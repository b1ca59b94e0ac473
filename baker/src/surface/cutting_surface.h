// SPDX-License-Identifier: MIT
// A surface while it is being cut: what lines of every kind work on.
#pragma once

#include <optional>
#include <span>

#include "surface/chords.h"
#include "surface/cut_surface.h"
#include "surface/matching.h"

namespace sherd {

class CuttingSurface {
  public:
    /// The arguments must outlive it.
    CuttingSurface(const SurfaceMesh& sourceMesh, const MeshTopology& topology,
                   const CutOptions& cutOptions);

    const SurfaceMesh& mesh;
    const CutOptions& options;
    CutSurface result;  ///< as far as it has come

    /// What one cut works with.
    struct Pass {
        const PlanarMap& map;
        std::span<const UvTriangle> frames;
        bool seams;         ///< frames have seams, over which line ends are joined
        uint32_t seamLine;  ///< mark that all seams get; 0: none
    };

    /// Cuts, and carries over what is known per triangle.
    Result<void> cutAlong(const Pass& pass, std::span<const Cut> cuts);
    /// Cuts along chords of the surface as it is.
    Result<void> cutChords(std::span<const Chord> chords);

    std::optional<glm::dvec2> uvAt(uint32_t triangle, const glm::dvec3& position) const;

  private:
    void markSeams(const Pass& pass, ResolvedEdges& edges) const;
    /// Where lines end in the middle of the surface.
    void findDeadEnds(const Pass& pass, std::span<const Cut> cuts);
    /// The place of the frame's point on the triangle.
    /// Whether a cut's end on an edge inside a chart is its line's own end, for reports.
    bool endsOnEdge(const Pass& pass, uint32_t triangle, const CutEnd& end, uint32_t node) const;
    glm::dvec3 positionAt(uint32_t triangle, const UvTriangle& frame, const glm::dvec2& uv) const;
};

}  // namespace sherd
