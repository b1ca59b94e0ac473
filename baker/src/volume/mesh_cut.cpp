// SPDX-License-Identifier: MIT
#include "volume/mesh_cut.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "volume/cell_complex.h"
#include "volume/coplanar_faces.h"
#include "volume/cut_result.h"
#include "volume/cut_vertex.h"
#include "volume/edge_windings.h"
#include "volume/face_caps.h"
#include "volume/polygon_fan.h"
#include "volume/triangle_cells.h"

namespace sherd {
namespace {

using Triangle = std::array<uint32_t, 3>;

/// The mesh's bounds on the grid, and one step around: the box's sides are outside.
CutBox boxAround(const std::vector<CutGridPoint>& points, std::span<const Triangle> triangles) {
    CutBox box{points[triangles[0][0]], points[triangles[0][0]]};
    for (const Triangle& t : triangles) {
        for (const uint32_t v : t) {
            const CutGridPoint& p = points[v];
            box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y),
                       std::min(box.low.z, p.z)};
            box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y),
                        std::max(box.high.z, p.z)};
        }
    }
    box.low = {box.low.x - 1, box.low.y - 1, box.low.z - 1};
    box.high = {box.high.x + 1, box.high.y + 1, box.high.z + 1};
    return box;
}

/// Of moving planes off coplanar faces.
constexpr int kMostRounds = 4;

/// One cut: what the stages hand to each other.
class Cutting {
  public:
    explicit Cutting(const CutInput& input)
        : input_(input),
          complex_(input.functions, boxAround(input.points, input.triangles),
                   kCoplanarBand * input.grid.extent() / input.grid.step()),
          vertices_(input),
          cells_(complex_, vertices_),
          result_(vertices_) {}

    /// The skin's parts, and the faces that lie in planes between cells.
    const std::vector<CoplanarFace>& cutSkin() {
        findCells();
        for (uint32_t t = 0; t < input_.triangles.size(); ++t) cutTriangle(t);
        return coplanar_;
    }

    /// After `cutSkin`.
    Result<MeshCut> run() {
        const auto inner = innerStretches(complex_, std::move(crossings_), vertices_);
        if (!inner) {
            return fail(ErrorCode::internal, "the mesh has no consistent inside; please report it");
        }
        result_.grow();
        for (const InnerStretch& stretch : *inner) addStretch(stretch);
        buildCaps();
        return result_.finish(input_.functions.count(), input_.triangles);
    }

  private:
    struct FaceEdge {
        uint32_t face;
        CapEdge edge;
    };

    void findCells() {
        cellOf_.resize(input_.points.size());
        nearPlane_.resize(input_.points.size());
        CellComplex::Place place{complex_.someCell(), false};
        for (size_t v = 0; v < input_.points.size(); ++v) {
            place = complex_.locate(input_.points[v], place.cell);
            cellOf_[v] = place.cell;
            nearPlane_[v] = place.nearPlane ? 1 : 0;
        }
    }

    void cutTriangle(uint32_t t) {
        const Triangle& v = input_.triangles[t];
        if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) return;
        const std::array<uint32_t, 3> cells{cellOf_[v[0]], cellOf_[v[1]], cellOf_[v[2]]};
        const bool mayLieInPlane =
            nearPlane_[v[0]] != 0 && nearPlane_[v[1]] != 0 && nearPlane_[v[2]] != 0;
        if (cells[0] == cells[1] && cells[1] == cells[2] && !mayLieInPlane) {
            result_.addSkin(cells[0], {v, t, MeshCut::kWhole});
            return;
        }
        for (const TriangleCells::Polygon& polygon : cells_.run(t, cells)) addPolygon(t, polygon);
    }

    void addPolygon(uint32_t t, const TriangleCells::Polygon& polygon) {
        const size_t n = polygon.sides.size();
        if (n == 0) return;
        if (!polygon.coplanar.empty()) addCoplanarFaces(input_, t, polygon, vertices_, coplanar_);
        result_.grow();
        for (size_t k = 0; k < n; ++k) {
            const TriangleCells::Side& side = polygon.sides[k];
            const TriangleCells::Side& next = polygon.sides[(k + 1) % n];
            const uint32_t from = polygon.corners[(k + n - 1) % n];
            const uint32_t to = polygon.corners[k];
            result_.uniteIfSame(from, to);
            if (side.edge) continue;
            // The cap has what the skin has, the other way round.
            if (polygon.cell < side.index) addCapEdge(polygon.cell, side.index, {to, from, 1, t});
            if (!next.edge && polygon.cell < std::min(side.index, next.index))
                addCrossing(polygon.cell, side, next, to);
        }
        addParts(t, polygon);
    }

    /// The parts of a triangle keep its direction; the polygon is convex.
    void addParts(uint32_t t, const TriangleCells::Polygon& polygon) {
        for (const Triangle& part : fan_.run(polygon.corners, vertices_)) {
            result_.addPart(polygon.cell, t, part,
                            {vertices_.weights(part[0], t), vertices_.weights(part[1], t),
                             vertices_.weights(part[2], t)});
        }
    }

    void addCrossing(uint32_t i, const TriangleCells::Side& a, const TriangleCells::Side& b,
                     uint32_t vertex) {
        const bool inOrder = a.index < b.index;
        const TriangleCells::Side& j = inOrder ? a : b;
        const TriangleCells::Side& k = inOrder ? b : a;
        // The sum of the weights is the edge's direction times the triangle's normal.
        const std::array<Int128, 3> w = cornerWeights(j.below, k.below);
        crossings_.push_back(
            {complex_.edgeOf(i, j.index, k.index), vertex, signOf(w[0] + w[1] + w[2])});
    }

    void addCapEdge(uint32_t low, uint32_t high, const CapEdge& edge) {
        faceEdges_.push_back({complex_.faceOf(low, high), edge});
    }

    /// The three faces at an edge i j k have the stretch in turn: i|j and j|k as it runs, i|k
    /// against it.
    void addStretch(const InnerStretch& s) {
        const auto& [i, j, k] = complex_.edges()[s.edge].cells;
        result_.uniteIfSame(s.from, s.to);
        addCapEdge(i, j, {s.from, s.to, s.winding, CapEdge::kNone});
        addCapEdge(j, k, {s.from, s.to, s.winding, CapEdge::kNone});
        addCapEdge(i, k, {s.from, s.to, -s.winding, CapEdge::kNone});
    }

    void buildCaps() {
        std::stable_sort(faceEdges_.begin(), faceEdges_.end(),
                         [](const FaceEdge& a, const FaceEdge& b) { return a.face < b.face; });
        CapBuilder builder(vertices_, result_.merged());
        std::vector<CapEdge> border;
        size_t n = 0;
        for (uint32_t low = 0; low < input_.functions.count(); ++low) {
            for (const uint32_t high : complex_.neighbors(low)) {
                if (high < low) continue;
                const uint32_t face = complex_.faceOf(low, high);
                border.clear();
                for (; n < faceEdges_.size() && faceEdges_[n].face == face; ++n)
                    border.push_back(faceEdges_[n].edge);
                if (!border.empty()) result_.addCap(builder, low, high, border);
            }
        }
        result_.takeReport(builder);
    }

    const CutInput& input_;
    CellComplex complex_;
    CutVertices vertices_;
    TriangleCells cells_;
    PolygonFan fan_;
    CutResult result_;
    std::vector<uint32_t> cellOf_;    ///< per vertex of the mesh
    std::vector<uint8_t> nearPlane_;  ///< likewise
    std::vector<CoplanarFace> coplanar_;
    std::vector<EdgeCrossing> crossings_;
    std::vector<FaceEdge> faceEdges_;
};

}  // namespace

Result<MeshCut> cutMesh(std::span<const glm::vec3> positions, std::span<const Triangle> triangles,
                        const CutGrid& grid, CellFunctions cells, const MeshCutOptions& options) {
    if (auto ok = checkCuttable(positions, triangles); !ok) return tl::unexpected(ok.error());
    const CutInput input{grid,  positions,     triangles, snapped(grid, positions, triangles),
                         cells, options.shared};
    MovedPlanes planes;
    MeshCut::Report report;
    // Moved planes may come to lie in other faces: a few rounds, then ties have to do.
    for (int round = 0;; ++round) {
        Cutting cutting(input);
        const std::vector<CoplanarFace>& coplanar = cutting.cutSkin();
        if (!options.shared) planes = movePlanes(cells, coplanar, grid.extent() / grid.step());
        if (planes.moved == 0 || round == kMostRounds) {
            Result<MeshCut> cut = cutting.run();
            if (!cut) return cut;
            cut->report.movedPlanes = report.movedPlanes;
            cut->report.opposedPlanes = report.opposedPlanes;
            cut->functions = std::move(cells);
            return cut;
        }
        report.movedPlanes += planes.moved;
        report.opposedPlanes += planes.opposed;
        Result<CellFunctions> moved = CellFunctions::of(std::move(planes.families));
        if (!moved) return tl::unexpected(moved.error());
        cells = std::move(*moved);
    }
}

Result<SettledCells> settleCells(std::span<const glm::vec3> positions,
                                 std::span<const Triangle> triangles, const CutGrid& grid,
                                 CellFunctions cells) {
    if (triangles.empty()) return fail(ErrorCode::noTriangles, "there is nothing to cut");
    const CutInput input{grid, positions, triangles, snapped(grid, positions, triangles), cells};
    SettledCells result;
    for (int round = 0; round < kMostRounds; ++round) {
        Cutting cutting(input);
        MovedPlanes planes = movePlanes(cells, cutting.cutSkin(), grid.extent() / grid.step());
        if (planes.moved == 0) break;
        result.moved += planes.moved;
        result.opposed += planes.opposed;
        Result<CellFunctions> moved = CellFunctions::of(std::move(planes.families));
        if (!moved) return tl::unexpected(moved.error());
        cells = std::move(*moved);
    }
    result.functions = std::move(cells);
    return result;
}

}  // namespace sherd
