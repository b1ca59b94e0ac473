// SPDX-License-Identifier: MIT
// What of a triangle of the mesh lies in which cell of the drawing.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "volume/key_table.h"
#include "volume/prism_vertices.h"

namespace sherd {

class PrismPolygons {
  public:
    struct Edge {
        static constexpr uint32_t kSkin = 0xFFFFFFFFU;
        uint32_t from, to;  ///< vertices
        uint32_t side;      ///< of the cell that it lies in, its place among them; kSkin: none, it
                            ///< is part of an edge of the triangle
    };
    struct Polygon {
        uint32_t cell = 0;
        std::vector<Edge> edges;  ///< one after the other, as the triangle turns
    };

    PrismPolygons(const PrismInput& input, PrismVertices& vertices);

    /// False if the mesh's vertices cannot be found in the drawing's cells.
    bool locate();
    /// The whole triangle, if it is in one cell.
    std::optional<uint32_t> cellOf(uint32_t triangle);
    /// Good until the next call; empty if they cannot be put together.
    std::span<const Polygon> run(uint32_t triangle);
    /// 1: the triangle turns left in the drawing's plane, -1 right, 0 it stands upright.
    int turnOf(uint32_t triangle) const;
    /// Nodes of the drawing within the last triangle.
    std::span<const uint32_t> nodes() const { return nodes_; }

  private:
    struct Crossing {
        uint32_t cell;  ///< that is left, or entered last
        uint32_t side;  ///< its side
    };
    struct Met {
        uint32_t line, vertex;
        bool
            enters;  ///< going along the line from its first node, where the triangle is no upright
    };
    bool walk(uint32_t from, uint32_t to, uint32_t& cell, std::vector<Crossing>* path) const;
    std::span<const Crossing> pathOf(uint32_t u, uint32_t v);
    bool isInside(uint32_t node, uint32_t triangle, int turn);
    void addSides(uint32_t triangle);
    void addWalls(uint32_t triangle, int turn, size_t polygon);
    size_t reach(uint32_t cell);
    static bool link(Polygon& polygon);

    const PrismInput& input_;
    PrismVertices& vertices_;
    std::vector<uint32_t> cellOf_;  ///< per mesh vertex
    KeyTable edges_;
    std::vector<uint32_t> pathStart_{0};
    std::vector<Crossing> paths_, path_;
    std::vector<Polygon> polygons_;
    size_t count_ = 0;
    std::vector<Met> met_;
    std::vector<uint32_t> nodes_;
};

}  // namespace sherd
