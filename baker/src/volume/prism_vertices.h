// SPDX-License-Identifier: MIT
// The vertices of a cut by prisms, implicit: each is what makes it, and is numbered and placed
// once.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "volume/cap_space.h"
#include "volume/cut_grid.h"
#include "volume/prism_map.h"

namespace sherd {

/// As it is seen along an axis.
inline PlanePoint planePoint(const CutGridPoint& p, uint32_t axis) {
    return axis == 0   ? PlanePoint{p.y, p.z}
           : axis == 1 ? PlanePoint{p.z, p.x}
                       : PlanePoint{p.x, p.y};
}

/// A mesh and the drawing that is projected straight through it.
struct PrismInput {
    const CutGrid& grid;
    const PrismMap& map;
    uint32_t axis = 2;  ///< of the projection; the drawing's x is the next axis, y the one after
    std::span<const glm::vec3> positions;
    std::span<const std::array<uint32_t, 3>> triangles;
    std::vector<CutGridPoint> points = {};  ///< the positions on the grid
    bool shared = false;                    ///< see MeshCutOptions

    PlanePoint planar(uint32_t vertex) const { return planePoint(points[vertex], axis); }
    int64_t depth(uint32_t vertex) const {
        const CutGridPoint& p = points[vertex];
        return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
    }
};

class PrismVertices final : public CapSpace {
  public:
    explicit PrismVertices(const PrismInput& input);

    /// Where an edge of the mesh crosses a line of the drawing.
    uint32_t onEdge(uint32_t u, uint32_t v, uint32_t line);
    /// Where the straight line over a node crosses a triangle.
    uint32_t atNode(uint32_t triangle, uint32_t node);

    /// -1, 0, 1: the order along the axis of two vertices over the same node.
    int compareDepth(uint32_t a, uint32_t b) const;
    const glm::vec3& position(uint32_t vertex) const override { return world_[vertex]; }
    /// Of the corners of a triangle that the vertex lies on.
    glm::dvec3 weights(uint32_t vertex, uint32_t triangle) const;

    /// The line that `normal` and `atCrossing` are about; seen from the cell on its right.
    void setWall(uint32_t line, bool turned) {
        wall_ = line;
        turned_ = turned;
    }
    bool shared() const override { return input_.shared; }
    uint32_t count() const override { return static_cast<uint32_t>(grid_.size()); }
    const glm::dvec3& gridPosition(uint32_t vertex) const override { return grid_[vertex]; }
    ExactPlace exactPlace(uint32_t vertex) const override;
    glm::dvec3 normal(uint32_t i, uint32_t j) const override;
    uint32_t atCrossing(uint32_t s, uint32_t t, uint32_t i, uint32_t j) override;

  private:
    enum class Kind : uint32_t { edge, node, crossing };
    struct Made {
        Kind kind;
        std::array<uint32_t, 3>
            of;              ///< edge: u, v, line; node: triangle, node; crossing: s, t, line
        glm::dvec3 weights;  ///< edge: of u, v; node: of the triangle's corners
    };
    uint32_t add(const Made& made, const glm::dvec3& grid, const glm::dvec3& world);
    uint32_t find(Kind kind, const std::array<uint32_t, 3>& of) const;
    std::array<Int128, 3> cornerWeights(uint32_t triangle, uint32_t node) const;
    ExactPlane wallPlane(uint32_t line) const;
    ExactPlane trianglePlane(uint32_t triangle) const;

    const PrismInput& input_;
    uint32_t meshCount_;
    KeyTable keys_;
    std::vector<Made> made_;  ///< from vertex meshCount_ on
    std::vector<glm::dvec3> grid_;
    std::vector<glm::vec3> world_;
    uint32_t wall_ = 0;
    bool turned_ = false;
};

}  // namespace sherd
