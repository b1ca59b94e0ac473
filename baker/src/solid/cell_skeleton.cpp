// SPDX-License-Identifier: MIT
// A line where three cells meet is the meet of their bisector planes. It goes on until a fourth
// cell is as near: a vertex of the Voronoi diagram, if it lies inside. With cells within cells
// (levels) the same holds with the planes that part each two of them, at the first level where they
// differ.
#include "solid/cell_skeleton.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <set>

#include "geometry/ray_hit.h"

namespace sherd {
namespace {

using Triple = std::array<uint32_t, 3>;  ///< ascending
using Quadruple = std::array<uint32_t, 4>;

template <size_t N>
std::array<uint32_t, N> sorted(std::array<uint32_t, N> pieces) {
    std::sort(pieces.begin(), pieces.end());
    return pieces;
}

/// A way along the line of three pieces.
struct Walk {
    Triple pieces{};
    uint32_t from = 0;  ///< end of the skeleton
    glm::dvec3 place{0.0};
    glm::dvec3 along{0.0};  ///< unit
};

class CellWalker {
  public:
    CellWalker(const SplitSurface& surface, const CellSpace& space, const BorderGraph& graph,
               Skeleton& skeleton)
        : surface_(surface),
          space_(space),
          graph_(graph),
          skeleton_(skeleton),
          tree_(surface.positions, vertexTriangles(surface)),
          size_(boundsOf(surface).diagonal()) {}

    void run() {
        for (uint32_t n = 0; n < graph_.nodes.size(); ++n) {
            const BorderNode& node = graph_.nodes[n];
            if (!node.plain || node.spokes.size() != 3) continue;
            const std::vector<uint32_t> around = piecesAround(node, false);
            nodesOf_[sorted<3>({around[0], around[1], around[2]})].push_back(n);
        }
        for (const auto& [pieces, nodes] : nodesOf_)
            for (const uint32_t n : nodes) startAt(n, pieces);
        while (!walks_.empty()) {
            const Walk walk = walks_.back();
            walks_.pop_back();
            follow(walk);
        }
    }

  private:
    glm::dvec3 positionOf(uint32_t node) const {
        return surface_.positions[graph_.nodes[node].vertex];
    }

    /// The line of three pieces, if they have one.
    std::optional<glm::dvec3> lineOf(const Triple& pieces) const {
        const auto ab = space_.between(pieces[0], pieces[1]);
        const auto ac = space_.between(pieces[0], pieces[2]);
        const auto bc = space_.between(pieces[1], pieces[2]);
        if (!ab || !ac || !bc) return std::nullopt;
        // Two of the three may be one plane: that with a cell of a shallower level.
        glm::dvec3 best(0.0);
        for (const glm::dvec3& n :
             {glm::cross(ab->normal, ac->normal), glm::cross(ab->normal, bc->normal),
              glm::cross(ac->normal, bc->normal)})
            if (glm::dot(n, n) > glm::dot(best, best)) best = n;
        const double length = glm::length(best);
        constexpr double kParallel = 1e-9;
        if (!(length > kParallel)) return std::nullopt;
        return best / length;
    }

    bool isOnLine(const glm::dvec3& place, const Triple& pieces) const {
        const double reach = kNear * size_;
        for (size_t k = 0; k < 3; ++k) {
            const auto plane = space_.between(pieces[k], pieces[(k + 1) % 3]);
            if (!plane || std::abs(plane->at(place)) > reach) return false;
        }
        return true;
    }

    /// Inwards from a node: the pieces lie counter-clockwise around the way out.
    void startAt(uint32_t node, const Triple& pieces) {
        const glm::dvec3 place = positionOf(node);
        const auto line = lineOf(pieces);
        if (!line || !isOnLine(place, pieces)) return;
        const std::vector<uint32_t> around = piecesAround(graph_.nodes[node], false);
        const auto towards = [&](uint32_t piece) { return awayFromOthers(piece, pieces, *line); };
        const glm::dvec3 turn = glm::cross(towards(around[0]), towards(around[1]));
        const bool isOut = glm::dot(turn, *line) > 0;
        walks_.push_back({pieces, node, place, isOut ? -*line : *line});
    }

    /// A direction across the line into one of its three pieces.
    glm::dvec3 awayFromOthers(uint32_t piece, const Triple& pieces, const glm::dvec3& line) const {
        glm::dvec3 sum(0.0);
        for (const uint32_t other : pieces) {
            if (other == piece) continue;
            sum -= space_.between(piece, other)->normal;
        }
        return sum - line * glm::dot(sum, line);
    }

    void follow(const Walk& walk) {
        if (!walked_.insert({walk.from, walk.pieces}).second) return;
        const auto [fourth, way] = nextPiece(walk);
        const RayHit hit = firstHit(tree_, walk.place + kStart * size_ * walk.along, walk.along);
        if (hit.triangle == RayHit::kNone) return;
        if (fourth != kNone && way < hit.t) {
            arriveAtHub(walk, fourth, walk.place + way * walk.along);
        } else {
            arriveAtNode(walk, walk.place + hit.t * walk.along);
        }
    }

    /// The first other piece that becomes as near as the three, and how far along that is.
    std::pair<uint32_t, double> nextPiece(const Walk& walk) const {
        std::pair<uint32_t, double> first{kNone, std::numeric_limits<double>::infinity()};
        const auto met = meetAt(walk.from);
        for (uint32_t piece = 0; piece < space_.leafCount(); ++piece) {
            if (std::find(met.begin(), met.end(), piece) != met.end()) continue;
            const double way = whereWins(piece, walk);
            if (!(way < first.second + kNear * size_)) continue;
            if (way < first.second - kNear * size_ || first.first == kNone) {
                first = {piece, way};
                continue;
            }
            // Pieces of one cell come in together: the one that is nearest there.
            const auto plane = space_.between(first.first, piece);
            const glm::dvec3 place = walk.place + std::max(way, first.second) * walk.along;
            if (plane && plane->at(place) > 0) first = {piece, way};
        }
        return first;
    }

    /// The pieces that meet where a walk begins.
    std::vector<uint32_t> meetAt(uint32_t end) const {
        if (!skeleton_.isHub(end)) return piecesAround(graph_.nodes[end], false);
        const Quadruple& pieces = hubPieces_[end - skeleton_.nodes];
        return {pieces.begin(), pieces.end()};
    }

    /// From where on a piece is nearer than those of the walk; infinite if never.
    double whereWins(uint32_t piece, const Walk& walk) const {
        constexpr double kNever = std::numeric_limits<double>::infinity();
        constexpr double kAlong = 1e-9;
        double way = 0;
        for (const uint32_t own : walk.pieces) {
            const auto plane = space_.between(own, piece);
            if (!plane) return kNever;
            const double slope = glm::dot(plane->normal, walk.along);
            const double value = plane->at(walk.place);
            // Level with it: a piece that the first cuts of both keep equally near.
            const bool isLevel = std::abs(slope) <= kAlong && value > -kNear * size_;
            if (isLevel) continue;
            if (slope <= 0) return kNever;
            way = std::max(way, -value / slope);
        }
        return way;
    }

    void arriveAtHub(const Walk& walk, uint32_t fourth, const glm::dvec3& place) {
        const Quadruple pieces =
            sorted<4>({walk.pieces[0], walk.pieces[1], walk.pieces[2], fourth});
        const auto [it, isNew] = hubs_.try_emplace(pieces, 0);
        if (isNew) {
            it->second = skeleton_.addHub(place);
            hubPieces_.push_back(pieces);
        }
        const uint32_t hub = it->second;
        if (!walked_.insert({hub, walk.pieces}).second) return;  // from its other end already
        skeleton_.addLine(walk.from, hub, {walk.pieces.begin(), walk.pieces.end()});
        if (!isNew) return;
        for (const uint32_t missing : walk.pieces) {
            Triple rest{};
            std::copy_if(pieces.begin(), pieces.end(), rest.begin(),
                         [missing](uint32_t p) { return p != missing; });
            if (const auto along = awayFrom(missing, rest))
                walks_.push_back({rest, hub, place, *along});
        }
    }

    /// Along the line of three pieces to where a fourth loses.
    std::optional<glm::dvec3> awayFrom(uint32_t fourth, const Triple& pieces) const {
        const auto line = lineOf(pieces);
        if (!line) return std::nullopt;
        double most = 0;
        for (const uint32_t piece : pieces) {
            const auto plane = space_.between(piece, fourth);
            if (!plane) return std::nullopt;
            const double slope = glm::dot(plane->normal, *line);
            if (std::abs(slope) > std::abs(most)) most = slope;
        }
        if (most == 0) return std::nullopt;
        return most < 0 ? *line : -*line;
    }

    /// The nearest node of the same pieces around the place where the line leaves the solid.
    void arriveAtNode(const Walk& walk, const glm::dvec3& place) {
        const auto found = nodesOf_.find(walk.pieces);
        if (found == nodesOf_.end()) return;
        uint32_t best = kNone;
        double least = kFound * size_;
        for (const uint32_t node : found->second) {
            const double distance = glm::distance(positionOf(node), place);
            if (node == walk.from || !(distance < least)) continue;
            best = node;
            least = distance;
        }
        if (best == kNone || !walked_.insert({best, walk.pieces}).second) return;
        skeleton_.addLine(walk.from, best, {walk.pieces.begin(), walk.pieces.end()});
    }

    // Shares of the diagonal.
    static constexpr double kNear = 1e-6;   ///< what counts as one place
    static constexpr double kStart = 1e-6;  ///< where rays begin
    static constexpr double kFound = 1e-3;  ///< where a line may come out beside its node

    const SplitSurface& surface_;
    const CellSpace& space_;
    const BorderGraph& graph_;
    Skeleton& skeleton_;
    TriangleBvh tree_;
    double size_;
    std::map<Triple, std::vector<uint32_t>> nodesOf_;
    std::map<Quadruple, uint32_t> hubs_;
    std::vector<Quadruple> hubPieces_;  ///< per hub
    std::vector<Walk> walks_;
    std::set<std::pair<uint32_t, Triple>> walked_;  ///< end, pieces
};

}  // namespace

void followCells(const SplitSurface& surface, const CellSpace& space, const BorderGraph& graph,
                 Skeleton& skeleton) {
    CellWalker(surface, space, graph, skeleton).run();
}

}  // namespace sherd
