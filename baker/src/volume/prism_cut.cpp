// SPDX-License-Identifier: MIT
#include "volume/prism_cut.h"

#include <algorithm>
#include <optional>
#include <tuple>
#include <utility>

#include "volume/cut_result.h"
#include "volume/face_caps.h"
#include "volume/polygon_fan.h"
#include "volume/prism_polygons.h"

namespace sherd {
namespace {

using Triangle = std::array<uint32_t, 3>;

class PrismCutting {
  public:
    explicit PrismCutting(const PrismInput& input)
        : input_(input),
          vertices_(input),
          polygons_(input, vertices_),
          result_(vertices_),
          wallEdges_(input.map.lines()),
          stretches_(input.map.nodes()) {}

    Result<MeshCut> run() {
        if (!polygons_.locate()) return contradiction();
        for (uint32_t t = 0; t < input_.triangles.size(); ++t)
            if (!cutTriangle(t)) return contradiction();
        if (!findStretches()) return contradiction();
        buildCaps();
        return result_.finish(input_.map.cells(), input_.triangles);
    }

  private:
    struct NodeCrossing {
        uint32_t node, vertex;
        int leaves;  ///< 1: going up the solid is left there, -1: entered
    };
    struct Stretch {
        uint32_t from, to;
        int winding;
    };
    struct Wall {
        uint32_t low, high;
        PrismMap::Side side;  ///< of the lower cell
    };

    static Result<MeshCut> contradiction() {
        return fail(ErrorCode::internal,
                    "the mesh and the drawing do not fit each other; please report it");
    }

    bool cutTriangle(uint32_t t) {
        const Triangle& v = input_.triangles[t];
        if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) return true;
        if (const std::optional<uint32_t> cell = polygons_.cellOf(t)) {
            result_.addSkin(*cell, {v, t, MeshCut::kWhole});
            return true;
        }
        const auto polygons = polygons_.run(t);
        result_.grow();
        for (const PrismPolygons::Polygon& polygon : polygons) addPolygon(t, polygon);
        for (const uint32_t node : polygons_.nodes())
            crossings_.push_back({node, vertices_.atNode(t, node), polygons_.turnOf(t)});
        return !polygons.empty();
    }

    void addPolygon(uint32_t t, const PrismPolygons::Polygon& polygon) {
        corners_.clear();
        for (const PrismPolygons::Edge& edge : polygon.edges) {
            corners_.push_back(edge.from);
            result_.uniteIfSame(edge.from, edge.to);
            if (edge.side == PrismPolygons::Edge::kSkin) continue;
            const PrismMap::Side& side = input_.map.sides(polygon.cell)[edge.side];
            // The cap has what the skin has, the other way round.
            if (input_.map.isWall(side.line) && polygon.cell < side.across)
                wallEdges_[side.line].push_back({edge.to, edge.from, 1, t});
        }
        for (const Triangle& part : fan_.run(corners_, vertices_)) {
            result_.addPart(polygon.cell, t, part,
                            {vertices_.weights(part[0], t), vertices_.weights(part[1], t),
                             vertices_.weights(part[2], t)});
        }
    }

    /// Over each node from below: every triangle takes one off the winding number or adds one.
    bool findStretches() {
        std::sort(crossings_.begin(), crossings_.end(),
                  [&](const NodeCrossing& a, const NodeCrossing& b) {
                      if (a.node != b.node) return a.node < b.node;
                      const int order = vertices_.compareDepth(a.vertex, b.vertex);
                      if (order != 0) return order < 0;
                      // In one place, what enters comes first.
                      return std::tie(a.leaves, a.vertex) < std::tie(b.leaves, b.vertex);
                  });
        int winding = 0;
        for (size_t n = 0; n < crossings_.size(); ++n) {
            const NodeCrossing& c = crossings_[n];
            winding -= c.leaves;
            const bool last = n + 1 == crossings_.size() || crossings_[n + 1].node != c.node;
            if (last && winding != 0) return false;
            if (winding == 0) continue;
            const uint32_t next = crossings_[n + 1].vertex;
            result_.uniteIfSame(c.vertex, next);
            stretches_[c.node].push_back({c.vertex, next, winding});
        }
        return true;
    }

    std::vector<Wall> walls() const {
        std::vector<Wall> walls;
        for (uint32_t cell = 0; cell < input_.map.cells(); ++cell)
            for (const PrismMap::Side& side : input_.map.sides(cell))
                if (side.across != PrismMap::kNone && cell < side.across &&
                    input_.map.isWall(side.line))
                    walls.push_back({cell, side.across, side});
        std::sort(walls.begin(), walls.end(), [](const Wall& a, const Wall& b) {
            return std::tie(a.low, a.high, a.side.line) < std::tie(b.low, b.high, b.side.line);
        });
        return walls;
    }

    void buildCaps() {
        CapBuilder builder(vertices_, result_.merged());
        for (const Wall& wall : walls()) {
            std::vector<CapEdge>& border = wallEdges_[wall.side.line];
            // Seen from the higher cell the wall runs to the right: up at its end, down at its
            // start.
            for (const Stretch& s : stretches_[wall.side.to])
                border.push_back({s.from, s.to, s.winding, CapEdge::kNone});
            for (const Stretch& s : stretches_[wall.side.from])
                border.push_back({s.from, s.to, -s.winding, CapEdge::kNone});
            if (border.empty()) continue;
            vertices_.setWall(wall.side.line,
                              input_.map.line(wall.side.line).from != wall.side.from);
            result_.addCap(builder, wall.low, wall.high, border);
        }
        result_.takeReport(builder);
    }

    const PrismInput& input_;
    PrismVertices vertices_;
    PrismPolygons polygons_;
    CutResult result_;
    PolygonFan fan_;
    std::vector<uint32_t> corners_;
    std::vector<std::vector<CapEdge>> wallEdges_;  ///< per line
    std::vector<NodeCrossing> crossings_;
    std::vector<std::vector<Stretch>> stretches_;  ///< per node
};

}  // namespace

Result<MeshCut> cutByPrisms(std::span<const glm::vec3> positions,
                            std::span<const Triangle> triangles, const CutGrid& grid,
                            const PrismMap& map, uint32_t axis, const MeshCutOptions& options) {
    if (auto ok = checkCuttable(positions, triangles); !ok) return tl::unexpected(ok.error());
    const PrismInput input{
        grid, map, axis, positions, triangles, snapped(grid, positions, triangles), options.shared};
    return PrismCutting(input).run();
}

}  // namespace sherd
