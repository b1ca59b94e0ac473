// SPDX-License-Identifier: MIT
// What cutting lines into a mesh must give, by brute force and exact arithmetic, sharing nothing
// with the baker but its input types (boxes only save time):
//
//   1. all pairs of segments are crossed, which splits each into stretches
//   2. every stretch is clipped by every triangle; its ends on an edge are that edge's points
//   3. the lines under the stretches of a triangle, taken as endless, divide it into convex cells;
//      cells are united across all cell borders that no stretch covers
//   4. cells are united across the pieces of mesh edges that no line runs along
//
// Triangles whose UV is a line: every point of a stretch on that line stands for all places of the
// triangle that have this UV; they divide it into strips.
#pragma once

#include <array>
#include <map>
#include <vector>

#include "sherd/baker/fracture_map.h"
#include "sherd/baker/surface_mesh.h"
#include "support/exact_plane.h"

namespace sherd::test {

/// Levels count from 1; 0 is no line.
class CutOracle {
  public:
    struct Part {  ///< a stretch of a line inside a triangle, not along its edges
        exact::Point from, to;
        uint32_t level;
    };
    enum class Kind : uint8_t { skipped, area, line, point };
    struct Triangle {
        Kind kind = Kind::skipped;
        std::array<exact::Grid, 3> corner;
        int turn = 0;  ///< 1: corners run counter-clockwise
        std::vector<Part> parts;
    };
    struct Edge {
        std::array<uint32_t, 2> uses{};       ///< half edges low -> high, and back
        std::vector<exact::Fraction> points;  ///< from the low to the high vertex
        std::vector<uint32_t> pieceLevels;    ///< one more than points
    };
    struct Box {  ///< grid units, a unit wider on every side than what it holds
        double lowU, lowV, highU, highV;
        bool meets(const Box& other) const {
            return lowU <= other.highU && other.lowU <= highU && lowV <= other.highV &&
                   other.lowV <= highV;
        }
    };
    struct Sample {
        uint32_t triangle;
        std::array<double, 3> weights;
        uint32_t cell;
    };

    CutOracle(const SurfaceMesh& mesh, const FractureMap& map);

    /// Steps 3 and 4, which take the square of a triangle's lines. Only for meshes whose edges are
    /// used at most once in each direction.
    void findComponents();

    using EdgeKey = std::pair<uint32_t, uint32_t>;  ///< low, high vertex
    std::vector<Triangle> triangles;
    std::map<EdgeKey, Edge> edges;
    uint32_t levels = 0;
    std::vector<Sample> samples;                    ///< a place in every cell
    std::vector<std::vector<uint32_t>> components;  ///< [level - 1][cell]
    std::vector<uint32_t> counts;                   ///< [level - 1]

  private:
    struct Segment {
        exact::Grid a, b;
        uint32_t level;
        exact::Line line;
    };
    struct Stretch {
        exact::Point from, to;
        uint32_t segment;
        Box box;
    };
    struct Mark {  ///< a line along part of a mesh edge
        exact::Fraction from, to;
        uint32_t level;
    };
    struct Union {  ///< two cells with a common border
        uint32_t a, b;
        uint32_t level;  ///< 0: open
    };

    void snapMesh(const SurfaceMesh& mesh);
    void snapMap(const FractureMap& map);
    void crossSegments();
    void clip(uint32_t triangle, const Stretch& stretch);
    void conduct(uint32_t triangle, const Stretch& stretch);
    void conductAt(uint32_t triangle, const exact::Point& place, uint32_t level);
    void markEdge(uint32_t triangle, size_t k, const exact::Point& from, const exact::Point& to,
                  uint32_t level);
    void sortEdges();

    EdgeKey keyOf(uint32_t triangle, size_t k) const;
    /// The corner of half edge k at the low vertex of its edge, then the other.
    std::array<exact::Grid, 2> endsOf(uint32_t triangle, size_t k) const;
    std::vector<exact::Line> cellLines(const Triangle& triangle) const;
    void divide(uint32_t triangle);
    void divideIntoStrips(uint32_t triangle);
    void addCell(uint32_t triangle, const std::array<double, 3>& weights);
    void glueAndCount();

    std::vector<std::array<uint32_t, 3>> vertices_;
    std::vector<Segment> segments_;
    std::vector<Stretch> stretches_;
    std::map<EdgeKey, std::vector<Mark>> marks_;
    std::map<uint32_t, std::map<exact::Point, uint32_t>> strips_;  ///< of `line` triangles: level
    std::map<std::pair<uint32_t, uint32_t>, std::vector<uint32_t>>
        cellsAtPiece_;  ///< half edge, piece
    std::vector<Union> unions_;
};

}  // namespace sherd::test
