// SPDX-License-Identifier: MIT
#include <algorithm>
#include <optional>
#include <utility>

#include "geometry/no_index.h"
#include "volume/edge_pairing.h"
#include "volume/touching_edges.h"

namespace sherd {
namespace {

/// Follows uses of edges from piece to piece.
class ClashingUses {
  public:
    ClashingUses(const MeshCut& cut, const std::vector<BuiltPiece>& pieces)
        : cut_(cut),
          pieces_(pieces),
          taken_(cut.skin.size() + cut.capTriangles.size(), 0),
          places_(taken_.size(), {Place{kNone, 0}, Place{kNone, 0}}) {
        for (uint32_t p = 0; p < pieces.size(); ++p) {
            for (uint32_t t = 0; t < pieces[p].mesh.triangles.size(); ++t) {
                auto& places = places_[idOf(pieces[p].mesh.origins[t])];
                places[places[0].piece == kNone ? 0 : 1] = {p, t};
            }
        }
    }

    std::vector<EdgeUse> run() {
        for (uint32_t p = 0; p < pieces_.size(); ++p)
            for (const uint32_t h : pieces_[p].clashes) follow(p, h);
        return std::move(uses_);
    }

  private:
    struct Place {
        uint32_t piece, triangle;
    };
    CutTriangleId idOf(const PieceMesh::Origin& o) const {
        return o.cap ? static_cast<uint32_t>(cut_.skin.size()) + o.index : o.index;
    }
    static std::pair<uint32_t, uint32_t> endsOf(const BuiltPiece& piece, uint32_t h) {
        const auto& t = piece.mesh.triangles[h / 3];
        return std::minmax(piece.mesh.vertices[t[h % 3]], piece.mesh.vertices[t[(h % 3 + 1) % 3]]);
    }

    /// A triangle and its half edge at the use, in one of its pieces.
    struct Step {
        uint32_t piece, halfEdge;
        CutTriangleId id;
    };

    Step stepAt(uint32_t piece, uint32_t halfEdge) const {
        return {piece, halfEdge, idOf(pieces_[piece].mesh.origins[halfEdge / 3])};
    }

    /// The same triangle in its other piece; nothing for skin.
    std::optional<Step> otherSide(const Step& s) const {
        const std::array<Place, 2>& places = places_[s.id];
        const Place& place = places[places[0].piece == s.piece ? 1 : 0];
        if (place.piece == kNone) return std::nullopt;
        for (uint32_t h = 3 * place.triangle; h < 3 * place.triangle + 3; ++h) {
            if (endsOf(pieces_[place.piece], h) == endsOf(pieces_[s.piece], s.halfEdge))
                return stepAt(place.piece, h);
        }
        return std::nullopt;
    }

    /// From a triangle across a piece to its twin there, from cap to cap, until the outside or a
    /// piece that was crossed before. Then the triangles since are a use of their own: each piece
    /// has two of them, or none. They are in `path`, and true says that they are all.
    bool walk(std::optional<Step> at, std::vector<CutTriangleId>& path,
              std::vector<uint32_t>& crossed) const {
        while (at && pieces_[at->piece].twins[at->halfEdge] != EdgePairs::kNone) {
            const auto before = std::find(crossed.begin(), crossed.end(), at->piece);
            if (before != crossed.end()) {
                path.erase(path.begin(), path.begin() + (before - crossed.begin()) + 1);
                return true;
            }
            crossed.push_back(at->piece);
            const Step twin = stepAt(at->piece, pieces_[at->piece].twins[at->halfEdge]);
            path.push_back(twin.id);
            at = otherSide(twin);
        }
        return false;
    }

    /// Left for the next round if a triangle is part of another use already.
    void follow(uint32_t piece, uint32_t halfEdge) {
        const Step start = stepAt(piece, halfEdge);
        std::vector<CutTriangleId> path{start.id};
        std::vector<uint32_t> crossed;
        if (!walk(start, path, crossed)) {
            std::reverse(path.begin(), path.end());
            std::reverse(crossed.begin(), crossed.end());
            walk(otherSide(start), path, crossed);
        }
        if (std::any_of(path.begin(), path.end(),
                        [this](CutTriangleId id) { return taken_[id] != 0; })) {
            return;
        }
        for (const CutTriangleId id : path) taken_[id] = 1;
        const auto [a, b] = endsOf(pieces_[piece], halfEdge);
        uses_.push_back({a, b, std::move(path)});
    }

    const MeshCut& cut_;
    const std::vector<BuiltPiece>& pieces_;
    std::vector<uint8_t> taken_;
    std::vector<std::array<Place, 2>> places_;  ///< of each triangle of the cut
    std::vector<EdgeUse> uses_;
};

}  // namespace

std::vector<EdgeUse> clashingUses(const MeshCut& cut, const std::vector<BuiltPiece>& pieces) {
    return ClashingUses(cut, pieces).run();
}

}  // namespace sherd
