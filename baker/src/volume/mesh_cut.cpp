// SPDX-License-Identifier: MIT
#include "volume/mesh_cut.h"

#include <algorithm>
#include <glm/common.hpp>
#include <optional>
#include <utility>

#include "geometry/closed_mesh.h"
#include "geometry/union_find.h"
#include "volume/cell_complex.h"
#include "volume/coplanar_faces.h"
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
          merged_(vertices_.count()) {}

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
        merged_.grow(vertices_.count());
        for (const InnerStretch& stretch : *inner) addStretch(stretch);
        buildCaps();
        sortSkin();
        replaceUnited();
        return std::move(cut_);
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
            addSkin(cells[0], {v, t, MeshCut::kWhole});
            return;
        }
        for (const TriangleCells::Polygon& polygon : cells_.run(t, cells)) addPolygon(t, polygon);
    }

    void addSkin(uint32_t cell, const MeshCut::SkinTriangle& triangle) {
        skin_.push_back(triangle);
        cellOfSkin_.push_back(cell);
    }

    void addPolygon(uint32_t t, const TriangleCells::Polygon& polygon) {
        const size_t n = polygon.sides.size();
        if (n == 0) return;
        if (!polygon.coplanar.empty()) addCoplanarFaces(input_, t, polygon, vertices_, coplanar_);
        merged_.grow(vertices_.count());
        for (size_t k = 0; k < n; ++k) {
            const TriangleCells::Side& side = polygon.sides[k];
            const TriangleCells::Side& next = polygon.sides[(k + 1) % n];
            const uint32_t from = polygon.corners[(k + n - 1) % n];
            const uint32_t to = polygon.corners[k];
            uniteIfSame(from, to);
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
            const auto weights = static_cast<uint32_t>(cut_.weights.size());
            cut_.weights.push_back({vertices_.weights(part[0], t), vertices_.weights(part[1], t),
                                    vertices_.weights(part[2], t)});
            addSkin(polygon.cell, {part, t, weights});
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
        uniteIfSame(s.from, s.to);
        addCapEdge(i, j, {s.from, s.to, s.winding, CapEdge::kNone});
        addCapEdge(j, k, {s.from, s.to, s.winding, CapEdge::kNone});
        addCapEdge(i, k, {s.from, s.to, -s.winding, CapEdge::kNone});
    }

    /// Where a tie was broken, edges may have no length: their ends become one vertex.
    void uniteIfSame(uint32_t a, uint32_t b) {
        const glm::dvec3 d = glm::abs(vertices_.gridPosition(a) - vertices_.gridPosition(b));
        if (d.x > 0x1p-20 || d.y > 0x1p-20 || d.z > 0x1p-20) return;
        if (merged_.find(a) != merged_.find(b) &&
            vertices_.exactPlace(a) == vertices_.exactPlace(b)) {
            merged_.unite(a, b);
        }
    }

    void buildCaps() {
        std::stable_sort(faceEdges_.begin(), faceEdges_.end(),
                         [](const FaceEdge& a, const FaceEdge& b) { return a.face < b.face; });
        CapBuilder builder(vertices_, merged_);
        std::vector<CapEdge> border;
        size_t n = 0;
        for (uint32_t low = 0; low < input_.functions.count(); ++low) {
            for (const uint32_t high : complex_.neighbors(low)) {
                if (high < low) continue;
                const uint32_t face = complex_.faceOf(low, high);
                border.clear();
                for (; n < faceEdges_.size() && faceEdges_[n].face == face; ++n)
                    border.push_back(faceEdges_[n].edge);
                if (!border.empty()) buildCap(builder, low, high, border);
            }
        }
        cut_.report.crossedCaps = builder.report().crossed;
        cut_.report.fans = builder.report().fans;
    }

    void buildCap(CapBuilder& builder, uint32_t low, uint32_t high,
                  std::span<const CapEdge> border) {
        const auto first = static_cast<uint32_t>(cut_.capTriangles.size());
        builder.build(low, high, border, cut_.capTriangles);
        const auto count = static_cast<uint32_t>(cut_.capTriangles.size()) - first;
        if (count > 0) cut_.caps.push_back({low, high, first, count});
    }

    void sortSkin() {
        cut_.skinStart.assign(input_.functions.count() + 1, 0);
        for (const uint32_t cell : cellOfSkin_) ++cut_.skinStart[cell + 1];
        for (size_t c = 1; c < cut_.skinStart.size(); ++c)
            cut_.skinStart[c] += cut_.skinStart[c - 1];
        std::vector<uint32_t> next(cut_.skinStart.begin(), cut_.skinStart.end() - 1);
        cut_.skin.resize(skin_.size());
        for (size_t s = 0; s < skin_.size(); ++s) cut_.skin[next[cellOfSkin_[s]]++] = skin_[s];
    }

    /// United vertices get one number; triangles that lose their area by it stay, for they are
    /// somebody's skin, and are dropped when pieces are put together.
    void replaceUnited() {
        merged_.grow(vertices_.count());
        cut_.positions.resize(vertices_.count());
        for (uint32_t v = 0; v < vertices_.count(); ++v) {
            cut_.positions[v] = vertices_.position(v);
            cut_.report.united += merged_.find(v) != v ? 1 : 0;
        }
        if (cut_.report.united == 0) return;
        for (MeshCut::SkinTriangle& t : cut_.skin)
            for (uint32_t& v : t.v) v = merged_.find(v);
        for (CapTriangle& t : cut_.capTriangles)
            for (uint32_t& v : t.v) v = merged_.find(v);
        UnionFind parts(input_.positions.size());
        for (const Triangle& t : input_.triangles) {
            parts.unite(t[0], t[1]);
            parts.unite(t[0], t[2]);
        }
        for (const Triangle& t : input_.triangles) cut_.parts.push_back(parts.find(t[0]));
    }

    const CutInput& input_;
    CellComplex complex_;
    CutVertices vertices_;
    TriangleCells cells_;
    PolygonFan fan_;
    UnionFind merged_;
    std::vector<uint32_t> cellOf_;    ///< per vertex of the mesh
    std::vector<uint8_t> nearPlane_;  ///< likewise
    std::vector<MeshCut::SkinTriangle> skin_;
    std::vector<uint32_t> cellOfSkin_;
    std::vector<CoplanarFace> coplanar_;
    std::vector<EdgeCrossing> crossings_;
    std::vector<FaceEdge> faceEdges_;
    MeshCut cut_;
};

/// On the grid. What no triangle uses stays in the middle.
std::vector<CutGridPoint> snapUsed(std::span<const glm::vec3> positions,
                                   std::span<const Triangle> triangles, const CutGrid& grid) {
    std::vector<CutGridPoint> points(positions.size());
    for (const Triangle& t : triangles)
        for (const uint32_t v : t) points[v] = grid.snap(positions[v]);
    return points;
}

}  // namespace

Result<MeshCut> cutMesh(std::span<const glm::vec3> positions, std::span<const Triangle> triangles,
                        const CutGrid& grid, CellFunctions cells, const MeshCutOptions& options) {
    if (triangles.empty()) return fail(ErrorCode::noTriangles, "there is nothing to cut");
    if (!edgesCancel(triangles)) {
        return fail(ErrorCode::openMesh, "only closed meshes can be cut: there are open edges");
    }
    if (!(signedVolume(positions, triangles, positions[triangles[0][0]]) > 0)) {
        return fail(ErrorCode::invalidData,
                    "the mesh encloses no volume, or its triangles face inwards");
    }
    const CutInput input{grid,  positions,     triangles, snapUsed(positions, triangles, grid),
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
    const CutInput input{grid, positions, triangles, snapUsed(positions, triangles, grid), cells};
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
