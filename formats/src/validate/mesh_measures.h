// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "sherd/formats/fracture_set.h"

namespace sherd {

/// For each vertex the lowest vertex with an equal position (-0 equals 0).
std::vector<uint32_t> weldEqualPositions(const std::vector<glm::vec3>& positions);

struct EdgeDefects {
    uint32_t count = 0;               ///< undirected edges not used equally often both ways
    std::array<uint32_t, 2> first{};  ///< welded vertices of one of them
};

/// Counts unbalanced edges; its table is reused from fragment to fragment.
class EdgeBalance {
  public:
    void begin(size_t triangles);
    void add(uint32_t a, uint32_t b, uint32_t c);  ///< a triangle of welded vertices
    EdgeDefects defects() const;

  private:
    void addEdge(uint32_t from, uint32_t to);
    struct Slot {
        uint64_t key = 0;  ///< low vertex in the upper half; 0: free, as no edge joins 0 with 0
        int32_t net = 0;
    };
    std::vector<Slot> slots_;
    size_t mask_ = 0;
};

struct MeshMeasures {
    EdgeDefects edges;
    double volume = 0;         ///< m^3
    glm::dvec3 centroid{0};    ///< of the volume
    glm::dmat3 covariance{0};  ///< m^5: the integral of x x^T over the volume, x from the centroid
    glm::dvec3 low{0};         ///< bounding box
    glm::dvec3 high{0};
};

/// A triangle by its welded corners, in ascending order; the sign is that of the permutation.
struct Face {
    std::array<uint32_t, 3> corners{};
    int32_t sign = 0;
};
Face sortedFace(std::array<uint32_t, 3> corners);

/// Of unit density, from the integral of x x^T; and back.
glm::dmat3 inertiaOf(const glm::dmat3& covariance);
glm::dmat3 covarianceOf(const glm::dmat3& inertia);

class MeshMeasurer {
  public:
    explicit MeshMeasurer(const FractureSet& set);
    MeshMeasures measure(uint32_t fragment);
    const std::vector<uint32_t>& welded() const { return welded_; }

  private:
    const FractureSet& set_;
    std::vector<uint32_t> welded_;
    EdgeBalance balance_;
};

/// Calls `visit(primitive, a, b, c)` for every triangle that the fragment shows.
template <class Visit>
void forEachTriangle(const FractureSet& set, uint32_t fragment, Visit visit) {
    const std::vector<Primitive>& primitives = set.geometry.primitives;
    for (size_t p = 0; p < primitives.size(); ++p) {
        if (primitives[p].exposedFrom > set.fragments[fragment].level) continue;
        const Range range = set.fragmentRanges[fragment * primitives.size() + p];
        const uint32_t* corner = set.geometry.indices.data() + range.first;
        for (uint32_t i = 0; i + 2 < range.count; i += 3)
            visit(p, corner[i], corner[i + 1], corner[i + 2]);
    }
}

}  // namespace sherd
