// SPDX-License-Identifier: MIT
// The parts that are nearest to each patch meet in the medial surface, as the thesis' pieces do.
// Then every tetrahedron goes to where it has most of its faces as long as that makes walls smaller
// (iterated conditional modes, Besag 1986), which draws them tight.
#include "solid/inside_labels.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <map>

#include "geometry/triangle_bvh.h"
#include "solid/fan_repair.h"

namespace sherd {
namespace {

using Tetra = TetraComplex::Tetra;

class Labeller {
  public:
    Labeller(const TetraComplex& complex, const SplitSurface& before, const Components& pieces)
        : complex_(complex), pieces_(pieces), tree_(before.positions, vertexTriangles(before)) {
        result_.piece.assign(complex.tetras.size(), kNone);
        result_.broken.assign(pieces.leafCount, 0);
        fixed_.assign(complex.tetras.size(), 0);
        kept_.assign(complex.tetras.size(), 0);
    }

    InsideLabels run() {
        labelSkin();
        labelLumps();
        labelBesideEdges();
        labelAtVertices();
        labelAtFlatCaps();
        labelNearest();
        constexpr int kSweeps = 12;
        for (int sweep = 0; sweep < kSweeps && tighten(); ++sweep) {
        }
        FanRepair fans(complex_, pieces_, fixed_, result_.piece);
        constexpr int kRepairs = 8;
        for (int repair = 0; repair < kRepairs; ++repair) {
            const bool moved = joinIslands();
            result_.pinchedEdges = fans.run();
            if (!moved && result_.pinchedEdges == 0) break;
        }
        joinIslands();
        return std::move(result_);
    }

  private:
    glm::dvec3 at(uint32_t vertex) const { return complex_.positions[vertex]; }
    void fix(uint32_t tetra, uint32_t piece) {
        result_.piece[tetra] = piece;
        fixed_[tetra] = 1;
    }

    void labelSkin() {
        around_.assign(complex_.skin.positions.size(), kNone);
        for (uint32_t t = 0; t < complex_.tetras.size(); ++t) {
            const Tetra& tetra = complex_.tetras[t];
            if (tetra.skin == kNone) continue;
            const uint32_t piece = pieces_.leaf[complex_.skin.triangles[tetra.skin].parent];
            fix(t, piece);
            for (size_t k = 0; k < 3; ++k) {
                uint32_t& known = around_[tetra.v[k]];
                known = known == kNone || known == piece ? piece : kSeveral;
            }
        }
    }

    /// A lump whose core does not see all of it cannot be shared out.
    void labelLumps() {
        std::vector<uint32_t> ofLump(complex_.star.size(), kNone);
        for (uint32_t t = 0; t < complex_.tetras.size(); ++t) {
            const uint32_t lump = complex_.tetras[t].lump;
            if (complex_.star[lump] != 0 || complex_.tetras[t].skin == kNone) continue;
            uint32_t& known = ofLump[lump];
            if (known == kNone) known = result_.piece[t];
            if (known == result_.piece[t]) continue;
            result_.broken[known] = result_.broken[result_.piece[t]] = 1;
        }
        for (uint32_t t = 0; t < complex_.tetras.size(); ++t) {
            const uint32_t lump = complex_.tetras[t].lump;
            if (complex_.star[lump] == 0 && complex_.tetras[t].skin == kNone &&
                ofLump[lump] != kNone)
                fix(t, ofLump[lump]);
        }
    }

    void labelBesideEdges() {
        for (uint32_t t = 0; t < complex_.tetras.size(); ++t) {
            const Tetra& tetra = complex_.tetras[t];
            if (result_.piece[t] != kNone) continue;
            for (size_t k = 0; k < 3 && result_.piece[t] == kNone; ++k) {
                const uint32_t across = tetra.across[k];
                if (complex_.tetras[across].skin != kNone) fix(t, result_.piece[across]);
            }
        }
    }

    void labelAtVertices() {
        std::vector<uint32_t> open;
        for (uint32_t t = 0; t < complex_.tetras.size(); ++t) {
            if (result_.piece[t] != kNone) continue;
            const uint32_t v = skinVertexOf(t);
            if (v == kNone) continue;
            if (around_[v] != kSeveral && around_[v] != kNone) {
                fix(t, around_[v]);
            } else {
                open.push_back(t);
            }
        }
        while (!open.empty()) {
            std::vector<std::pair<uint32_t, uint32_t>> found;
            std::vector<uint32_t> left;
            for (const uint32_t t : open) {
                const uint32_t piece = pieceBeside(t, skinVertexOf(t));
                if (piece == kNone) {
                    left.push_back(t);
                } else {
                    found.emplace_back(t, piece);
                }
            }
            for (const auto& [t, piece] : found) fix(t, piece);
            if (found.empty()) break;
            open = std::move(left);
        }
    }

    /// Where the skin is flat, caps have triangles without width along it, whose middles lie in it
    /// too: a wall that came there would touch the skin from within.
    void labelAtFlatCaps() {
        std::vector<uint32_t> at(complex_.positions.size(), kNone);
        for (uint32_t v = static_cast<uint32_t>(complex_.skin.positions.size());
             v < complex_.firstCore; ++v)
            at[v] = pieceAt(complex_.positions[v]);
        for (uint32_t t = 0; t < complex_.tetras.size(); ++t) {
            for (size_t k = 0; k < 3; ++k) {
                const uint32_t piece = at[complex_.tetras[t].v[k]];
                if (result_.piece[t] != kNone || piece == kNone) continue;
                result_.piece[t] = piece;
                kept_[t] = 1;
            }
        }
    }

    /// The only piece whose skin is there, to rounding.
    uint32_t pieceAt(const glm::vec3& place) const {
        const auto reach = static_cast<float>(complex_.rounding);
        uint32_t piece = kNone;
        const auto near = [&](const glm::vec3& low, const glm::vec3& high) {
            for (int k = 0; k < 3; ++k)
                if (low[k] > place[k] + reach || high[k] < place[k] - reach) return false;
            return true;
        };
        tree_.forEach(near, [&](uint32_t t, const std::array<glm::vec3, 3>& c) {
            const glm::dvec3 p = place;
            if (glm::distance(closestOnTriangle(p, c[0], c[1], c[2]), p) > complex_.rounding)
                return;
            const uint32_t other = pieces_.leaf[t];
            piece = piece == kNone || piece == other ? other : kSeveral;
        });
        return piece == kSeveral ? kNone : piece;
    }

    uint32_t skinVertexOf(uint32_t t) const {
        for (size_t k = 0; k < 3; ++k)
            if (complex_.onSkin(complex_.tetras[t].v[k])) return complex_.tetras[t].v[k];
        return kNone;
    }

    /// Of the two neighbours in its lump that share the vertex.
    uint32_t pieceBeside(uint32_t t, uint32_t vertex) const {
        const Tetra& tetra = complex_.tetras[t];
        for (size_t k = 0; k < 3; ++k)
            if (tetra.v[k] != vertex && result_.piece[tetra.across[k]] != kNone)
                return result_.piece[tetra.across[k]];
        return kNone;
    }

    void labelNearest() {
        for (uint32_t t = 0; t < complex_.tetras.size(); ++t) {
            if (result_.piece[t] != kNone) continue;
            const Tetra& tetra = complex_.tetras[t];
            glm::dvec3 middle(0.0);
            for (const uint32_t v : tetra.v) middle += 0.25 * at(v);
            result_.piece[t] = pieces_.leaf[tree_.closest(middle).triangle];
        }
    }

    double areaOf(const Tetra& tetra, size_t face) const {
        const auto& f = kTetraFaces[face];
        const glm::dvec3 a = at(tetra.v[f[0]]);
        return 0.5 * glm::length(glm::cross(at(tetra.v[f[1]]) - a, at(tetra.v[f[2]]) - a));
    }

    /// One sweep; whether it changed anything.
    bool tighten() {
        bool changed = false;
        for (uint32_t t = 0; t < complex_.tetras.size(); ++t) {
            if (fixed_[t] != 0 || kept_[t] != 0) continue;
            const Tetra& tetra = complex_.tetras[t];
            std::map<uint32_t, double> shares;
            for (size_t k = 0; k < 4; ++k)
                if (tetra.across[k] != kNone)
                    shares[result_.piece[tetra.across[k]]] += areaOf(tetra, k);
            uint32_t best = result_.piece[t];
            double most = shares[best] * (1 + 1e-9);
            for (const auto& [piece, area] : shares) {
                if (!(area > most)) continue;
                best = piece;
                most = area;
            }
            changed = changed || best != result_.piece[t];
            result_.piece[t] = best;
        }
        return changed;
    }

    /// What hangs together with no patch of its piece goes to a neighbour. Whether anything did.
    bool joinIslands() {
        std::vector<uint8_t> reached(complex_.tetras.size(), 0);
        std::vector<uint32_t> queue;
        for (uint32_t t = 0; t < complex_.tetras.size(); ++t) {
            if (complex_.tetras[t].skin == kNone) continue;
            reached[t] = 1;
            queue.push_back(t);
        }
        flood(queue, reached, false);
        const auto before = static_cast<size_t>(std::count(reached.begin(), reached.end(), 1));
        queue.clear();
        for (uint32_t t = 0; t < reached.size(); ++t)
            if (reached[t] != 0) queue.push_back(t);
        flood(queue, reached, true);
        return before != reached.size();
    }

    void flood(std::vector<uint32_t>& queue, std::vector<uint8_t>& reached, bool takes) {
        for (size_t i = 0; i < queue.size(); ++i) {
            const uint32_t t = queue[i];
            for (const uint32_t n : complex_.tetras[t].across) {
                if (n == kNone || reached[n] != 0) continue;
                if (!takes && result_.piece[n] != result_.piece[t]) continue;
                result_.piece[n] = result_.piece[t];
                reached[n] = 1;
                queue.push_back(n);
            }
        }
    }

    static constexpr uint32_t kSeveral = kNone - 1;
    const TetraComplex& complex_;
    const Components& pieces_;
    TriangleBvh tree_;
    std::vector<uint8_t> fixed_;    ///< per tetrahedron: it must stay with its piece
    std::vector<uint8_t> kept_;     ///< per tetrahedron: only repairs may move it
    std::vector<uint32_t> around_;  ///< per vertex of the skin: its piece, or kSeveral
    InsideLabels result_;
};

}  // namespace

InsideLabels labelInside(const TetraComplex& complex, const SplitSurface& before,
                         const Components& pieces) {
    return Labeller(complex, before, pieces).run();
}

}  // namespace sherd
