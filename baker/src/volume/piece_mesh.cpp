// SPDX-License-Identifier: MIT
#include "volume/piece_mesh.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <map>
#include <numeric>
#include <utility>

#include "geometry/bounds.h"
#include "geometry/closed_mesh.h"
#include "geometry/no_index.h"
#include "geometry/union_find.h"
#include "volume/piece_builder.h"
#include "volume/touching_edges.h"

namespace sherd {
namespace {

/// Pieces as groups of cells, put together until none is a sliver and none touches itself where it
/// cannot be told apart.
class Assembly {
  public:
    Assembly(MeshCut& cut, const PieceOptions& options)
        : cut_(cut), options_(options), groups_(cut.cells()), main_(cut.cells()) {
        std::iota(main_.begin(), main_.end(), 0U);
        std::map<uint32_t, uint32_t> first;
        for (uint32_t cell = 0; cell < options.groups.size() && cell < cut.cells(); ++cell)
            groups_.unite(cell, first.try_emplace(options.groups[cell], cell).first->second);
    }

    CutPieces run() {
        constexpr int kMostMendings = 16;  // each mends what the one before left: two do nearly
        for (int round = 0;; ++round) {
            build();
            if (round == kMostMendings || (!mergeSlivers() && !halveClashes())) break;
        }
        CutPieces result;
        result.slivers = slivers_;
        result.pieceOfCell.assign(cut_.cells(), kNone);
        for (size_t p = 0; p < built_.size(); ++p) {
            if (built_[p].mesh.triangles.empty()) continue;
            for (const uint32_t cell : cells_[p])
                result.pieceOfCell[cell] = static_cast<uint32_t>(result.pieces.size());
            result.mainCell.push_back(main_[groups_.find(cells_[p][0])]);
            result.pieces.push_back(std::move(built_[p].mesh));
        }
        return result;
    }

  private:
    void build() {
        std::vector<uint32_t> groupOf(cut_.cells());
        pieceOf_.assign(cut_.cells(), kNone);
        cells_.clear();
        for (uint32_t cell = 0; cell < cut_.cells(); ++cell) {
            groupOf[cell] = groups_.find(cell);
            if (groupOf[cell] == cell) {
                pieceOf_[cell] = static_cast<uint32_t>(cells_.size());
                cells_.emplace_back();
            }
            pieceOf_[cell] = pieceOf_[groupOf[cell]];
            cells_[pieceOf_[cell]].push_back(cell);
        }
        PieceBuilder builder(cut_, std::move(groupOf));
        built_.clear();
        for (const std::vector<uint32_t>& cells : cells_) {
            built_.push_back(builder.build(cells));
            measure(built_.back().mesh);
        }
    }

    void measure(PieceMesh& mesh) const {
        if (mesh.triangles.empty()) return;
        const glm::dvec3 origin = cut_.positions[mesh.vertices[0]];
        double six = 0;
        for (const auto& t : mesh.triangles) {
            const auto corner = [&](size_t k) {
                return glm::dvec3(cut_.positions[mesh.vertices[t[k]]]) - origin;
            };
            six += glm::dot(corner(0), glm::cross(corner(1), corner(2)));
        }
        mesh.volume = six / 6;
    }

    /// Whether there were any with a neighbour.
    bool mergeSlivers() {
        double whole = 0;
        for (const BuiltPiece& piece : built_) whole += piece.mesh.volume;
        std::vector<uint8_t> slivers;
        for (const BuiltPiece& piece : built_) {
            const PieceMesh& mesh = piece.mesh;
            const bool isSmall = !(mesh.volume > options_.smallestShare * whole) || isFilm(mesh);
            slivers.push_back(isSmall && !mesh.triangles.empty() ? 1 : 0);
        }
        const auto isSliver = [&](uint32_t p) { return slivers[p] != 0; };
        std::vector<std::map<uint32_t, double>> shared(built_.size());  // area by neighbour
        for (const MeshCut::Cap& cap : cut_.caps) {
            const uint32_t a = pieceOf_[cap.low], b = pieceOf_[cap.high];
            if (a == b || (!isSliver(a) && !isSliver(b))) continue;
            const double area = areaOf(cap);
            shared[a][b] += area;
            shared[b][a] += area;
        }
        bool any = false;
        for (uint32_t p = 0; p < built_.size(); ++p) {
            if (!isSliver(p)) continue;
            const auto most =
                std::max_element(shared[p].begin(), shared[p].end(),
                                 [](const auto& a, const auto& b) { return a.second < b.second; });
            const uint32_t joined = most == shared[p].end() ? largestPiece() : most->first;
            const uint32_t own = cells_[p][0], other = cells_[joined][0];
            if (groups_.find(own) == groups_.find(other)) continue;  // merged with each other
            const bool isMore = built_[p].mesh.volume > built_[joined].mesh.volume;
            const uint32_t main = main_[groups_.find(isMore ? own : other)];
            groups_.unite(own, other);
            main_[groups_.find(own)] = main;
            ++slivers_;
            any = true;
        }
        return any;
    }

    /// Where slivers go that touch nothing: a fold of the skin, say, alone in its cell.
    uint32_t largestPiece() const {
        const auto most = std::max_element(
            built_.begin(), built_.end(),
            [](const BuiltPiece& a, const BuiltPiece& b) { return a.mesh.volume < b.mesh.volume; });
        return static_cast<uint32_t>(most - built_.begin());
    }

    bool isFilm(const PieceMesh& mesh) const {
        if (options_.thinnest <= 0) return false;
        double area = 0;
        for (const auto& t : mesh.triangles)
            area += areaOf(mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]);
        return mesh.volume <= options_.thinnest * 0.5 * area;
    }

    double areaOf(const MeshCut::Cap& cap) const {
        double area = 0;
        for (const CapTriangle& t : cut_.trianglesOf(cap)) area += areaOf(t.v[0], t.v[1], t.v[2]);
        return area;
    }

    double areaOf(uint32_t u, uint32_t v, uint32_t w) const {
        const glm::dvec3 a = cut_.positions[u];
        return 0.5 * glm::length(glm::cross(glm::dvec3(cut_.positions[v]) - a,
                                            glm::dvec3(cut_.positions[w]) - a));
    }

    bool halveClashes() {
        if (std::all_of(built_.begin(), built_.end(),
                        [](const BuiltPiece& p) { return p.clashes.empty(); })) {
            return false;
        }
        halveEdges(cut_, clashingUses(cut_, built_));
        return true;
    }

    MeshCut& cut_;
    const PieceOptions& options_;
    UnionFind groups_;
    std::vector<uint32_t> main_;                ///< per representative of a group: the cell that
                                                ///< holds most of it
    std::vector<std::vector<uint32_t>> cells_;  ///< per piece
    std::vector<uint32_t> pieceOf_;             ///< per cell
    std::vector<BuiltPiece> built_;
    uint32_t slivers_ = 0;
};

}  // namespace

std::vector<glm::vec3> PieceMesh::positions(const MeshCut& cut) const {
    std::vector<glm::vec3> result;
    result.reserve(vertices.size());
    for (const uint32_t v : vertices) result.push_back(cut.positions[v]);
    return result;
}

CutPieces assemblePieces(MeshCut& cut, const PieceOptions& options) {
    return Assembly(cut, options).run();
}

}  // namespace sherd
