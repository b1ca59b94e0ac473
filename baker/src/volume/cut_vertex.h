// SPDX-License-Identifier: MIT
// The vertices of a cut, implicit: each is what makes it, and is numbered and placed once.
//
// Places are rational numbers. Where coordinates matter exactly they are taken from the key as
// homogeneous integers; the rounded place is for filters and for output.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "geometry/perturbed_signs.h"
#include "volume/cap_space.h"
#include "volume/cell_family.h"
#include "volume/cut_grid.h"
#include "volume/key_table.h"

namespace sherd {

/// The mesh as it is cut: corners of triangles are below 2^25 in size.
struct CutInput {
    CutGrid grid;
    std::span<const glm::vec3> positions;
    std::span<const std::array<uint32_t, 3>> triangles;
    std::vector<CutGridPoint> points;  ///< the positions on the grid
    const CellFunctions& functions;
    bool shared = false;  ///< see MeshCutOptions: what is made in a triangle does not depend on
                          ///< the side it is seen from

    /// f_i - f_j at the corners of a triangle.
    CornerValues cornerValues(uint32_t triangle, uint32_t i, uint32_t j) const;
};

class CutVertices final : public CapSpace {
  public:
    enum class Kind : uint8_t {
        mesh,      ///< vertex v of the mesh
        edge,      ///< edge u v of the mesh, cells i j
        triangle,  ///< triangle t, cells i j k
        cells,     ///< cells i j k l
        crossing   ///< triangles s t, cells i j: where their sections cross
    };

    explicit CutVertices(const CutInput& input);

    /// Cells in any order; likewise the ends of an edge.
    uint32_t onEdge(uint32_t u, uint32_t v, uint32_t i, uint32_t j);
    uint32_t inTriangle(uint32_t t, uint32_t i, uint32_t j, uint32_t k);
    /// cells ascending; position: in grid steps.
    uint32_t atCells(const std::array<uint32_t, 4>& cells, const glm::dvec3& position);
    /// Nothing (kNone) where the planes of s, t and i|j have no common point.
    uint32_t atCrossing(uint32_t s, uint32_t t, uint32_t i, uint32_t j) override;

    bool shared() const override { return input_.shared; }
    uint32_t count() const override { return static_cast<uint32_t>(grid_.size()); }
    uint32_t meshCount() const { return meshCount_; }
    /// In grid steps, off by less than 2^-23 of one.
    const glm::dvec3& gridPosition(uint32_t vertex) const override { return grid_[vertex]; }
    glm::dvec3 normal(uint32_t i, uint32_t j) const override;
    const glm::vec3& position(uint32_t vertex) const override { return world_[vertex]; }
    ExactPlace exactPlace(uint32_t vertex) const override;
    Kind kind(uint32_t vertex) const;
    /// The weights of the corners of a triangle that the vertex lies on, as it is made there.
    glm::dvec3 weights(uint32_t vertex, uint32_t triangle) const;

    const CutInput& input() const { return input_; }

  private:
    /// Vertices of each kind but mesh are numbered by a table of their own.
    struct Made {
        Kind kind;
        uint32_t key;        ///< in the table of its kind
        glm::dvec3 weights;  ///< triangle: of its corners; edge: (1 - t, t) of u < v
    };
    uint32_t add(Kind kind, uint32_t key, const glm::dvec3& weights, const glm::dvec3& grid,
                 const glm::dvec3& world);
    KeyTable& table(Kind kind) { return tables_[static_cast<size_t>(kind)]; }
    const KeyTable::Key& keyOf(const Made& made) const {
        return tables_[static_cast<size_t>(made.kind)].keys()[made.key];
    }
    ExactPlace crossingPlace(const KeyTable::Key& key) const;

    const CutInput& input_;
    uint32_t meshCount_;
    std::array<KeyTable, 5> tables_;
    std::array<std::vector<uint32_t>, 5> vertexOfKey_;
    std::vector<Made> made_;  ///< from vertex meshCount_ on
    std::vector<glm::dvec3> grid_;
    std::vector<glm::vec3> world_;
};

}  // namespace sherd
