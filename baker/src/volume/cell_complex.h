// SPDX-License-Identifier: MIT
// How cells meet within the box around a mesh: which are neighbours, and the edges and vertices
// where three and four of them meet. Decided exactly, ties broken as in `perturbed_signs.h`, so
// that all cells agree and no more than three meet in an edge, no more than four in a vertex.
//
// Each cell is cut out of the box by the planes to the others, nearest first, until no farther one
// can reach it (Rycroft 2009, Voro++).
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "volume/cell_family.h"
#include "volume/convex_cell.h"
#include "volume/key_table.h"

namespace sherd {

class CellComplex {
  public:
    struct Vertex {
        std::array<uint32_t, 4> cells;  ///< ascending; sides of the box (`BoundingPlane`) last
        glm::dvec3 position;            ///< in grid steps
        bool onBox() const { return cells[3] >= BoundingPlane::kBox; }
    };
    /// Where cells i < j < k meet: from -> to runs along grad(f_i - f_j) x grad(f_i - f_k), which
    /// is counter-clockwise around the face i|j as seen from j.
    struct Edge {
        std::array<uint32_t, 3> cells;
        uint32_t from, to;  ///< vertices
    };

    /// band: half its width, in grid steps.
    CellComplex(const CellFunctions& functions, const CutBox& box, double band);

    const std::vector<Vertex>& vertices() const { return vertices_; }
    const std::vector<Edge>& edges() const { return edges_; }
    /// Cells that share a face with `cell` within the box, ascending.
    std::span<const uint32_t> neighbors(uint32_t cell) const {
        return std::span(neighbors_).subspan(start_[cell], start_[cell + 1] - start_[cell]);
    }
    /// For each of these how much higher its function may be within the band around their plane.
    std::span<const int64_t> bands(uint32_t cell) const {
        return std::span(band_).subspan(start_[cell], start_[cell + 1] - start_[cell]);
    }
    /// A number for the face low|high, below `faceCount()`; none for cells that share no face.
    uint32_t faceOf(uint32_t low, uint32_t high) const;
    uint32_t faceCount() const { return static_cast<uint32_t>(neighbors_.size()); }
    static constexpr uint32_t kNone = KeyTable::kNone;
    /// Ascending; kNone: no such edge.
    uint32_t edgeOf(uint32_t i, uint32_t j, uint32_t k) const { return edgeIndex_.find({i, j, k}); }

    /// The cell that a grid point of the box is in, walking from neighbour to neighbour; and
    /// whether it is within the band around the plane to one of its neighbours.
    struct Place {
        uint32_t cell;
        bool nearPlane;
    };
    Place locate(const CutGridPoint& p, uint32_t from) const;
    /// Any cell that is not empty.
    uint32_t someCell() const { return someCell_; }

  private:
    void add(uint32_t i, const ConvexCell& cell);
    uint32_t vertexOf(uint32_t i, const ConvexCell& cell, uint32_t corner);
    void addEdges(uint32_t i, const ConvexCell& cell, const ConvexCell::Face& face);

    const CellFunctions& functions_;
    std::vector<Vertex> vertices_;
    std::vector<Edge> edges_;
    std::vector<uint32_t> start_, neighbors_;
    std::vector<int64_t> band_;  ///< per neighbour: how much its function may be higher
    std::vector<uint32_t> vertexOfCorner_;
    KeyTable vertexIndex_, edgeIndex_;
    uint32_t someCell_ = 0;
};

}  // namespace sherd
