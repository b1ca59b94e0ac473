// SPDX-License-Identifier: MIT
// The mesh as the search for its medial surface sees it: in a unit frame, smoothed, and refined
// where its triangles are too coarse for the balls below them.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "geometry/bisection.h"
#include "geometry/vertex_corners.h"
#include "interior/ball_tree.h"
#include "interior/medial.h"
#include "interior/unit_frame.h"
#include "interior/vertex_normals.h"
#include "interior/vertex_rings.h"
#include "surface/split_surface.h"

namespace sherd {

/// Vertices with their balls, in the unit frame.
class MedialMesh {
  public:
    MedialMesh(const SurfaceMesh& mesh, const MeshTopology& topology, const MedialOptions& options);

    /// Cuts edges while the balls along them do not change evenly and they are longer than
    /// `refinement`.
    void refine();

    const UnitFrame& frame() const { return frame_; }
    const std::vector<glm::vec3>& feet() const { return feet_; }
    glm::vec3 centre(size_t v) const {
        return tangents_[v].point - balls_[v].radius * tangents_[v].normal;
    }
    float radius(size_t v) const { return balls_[v].radius; }
    bool hasBall(size_t v) const { return glm::dot(tangents_[v].normal, tangents_[v].normal) > 0; }
    BisectedTriangles& triangles() { return triangles_; }
    VertexRings rings() const { return rings(feet_.size()); }

  private:
    VertexRings rings(size_t vertices) const { return {vertices, triangles_}; }

    struct Refinement;
    struct Middle {
        VertexOrigin origin;
        glm::vec3 foot;
        BallTree::Tangent tangent;
        BallTree::Ball ball;
    };
    Middle middleOf(uint32_t halfEdge) const;
    BallTree::Ball ballBetween(uint32_t a, uint32_t b, const BallTree::Tangent& tangent) const;
    double length2(uint32_t halfEdge) const;
    std::array<uint32_t, 2> endsOf(uint32_t halfEdge) const;

    const SurfaceMesh& mesh_;
    const MedialOptions& options_;
    UnitFrame frame_;
    BisectedTriangles triangles_;
    VertexCorners corners_;                  ///< of the mesh
    std::vector<Facet> facets_;              ///< of the smoothed mesh
    std::vector<glm::dvec3> vertexNormals_;  ///< likewise
    std::vector<VertexOrigin> origins_;
    std::vector<glm::vec3> feet_;                    ///< on the surface
    std::vector<glm::vec3> smoothed_;                ///< of the mesh's vertices only
    std::vector<std::array<glm::vec3, 3>> normals_;  ///< of the mesh's corners, smoothed
    BallTree tree_;
    std::vector<BallTree::Tangent> tangents_;
    std::vector<BallTree::Ball> balls_;
};

}  // namespace sherd
