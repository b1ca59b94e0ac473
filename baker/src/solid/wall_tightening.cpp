// SPDX-License-Identifier: MIT
#include "solid/wall_tightening.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <set>

#include "solid/star_core.h"

namespace sherd {
namespace {

using Tetra = TetraComplex::Tetra;

class WallTightener {
  public:
    WallTightener(const InsideLabels& labels, TetraComplex& complex)
        : labels_(labels), complex_(complex) {
        tetrasAt_.resize(complex.positions.size());
        for (uint32_t t = 0; t < complex.tetras.size(); ++t)
            for (const uint32_t v : complex.tetras[t].v) tetrasAt_[v].push_back(t);
        findNeighbours();
    }

    void run() {
        constexpr int kSteps = 12;
        for (int step = 0; step < kSteps; ++step)
            for (const uint32_t v : movable_) move(v);
    }

  private:
    using Pieces = std::vector<uint32_t>;

    void findNeighbours() {
        const size_t count = complex_.positions.size();
        isFree_.assign(count, 1);
        piecesAt_.resize(count);
        neighbours_.resize(count);
        for (size_t v = 0; v < count; ++v) {
            for (const uint32_t t : tetrasAt_[v]) {
                piecesAt_[v].push_back(labels_.piece[t]);
                if (complex_.star[complex_.tetras[t].lump] == 0) isFree_[v] = 0;
            }
            std::sort(piecesAt_[v].begin(), piecesAt_[v].end());
            piecesAt_[v].erase(std::unique(piecesAt_[v].begin(), piecesAt_[v].end()),
                               piecesAt_[v].end());
        }
        for (uint32_t t = 0; t < complex_.tetras.size(); ++t) {
            const Tetra& tetra = complex_.tetras[t];
            for (size_t face = 0; face < 4; ++face) {
                const uint32_t across = tetra.across[face];
                const bool isWall = across != kNone && labels_.piece[across] != labels_.piece[t];
                for (const size_t i : kTetraFaces[face])
                    for (const size_t j : kTetraFaces[face])
                        if (i != j) addNeighbour(tetra.v[i], tetra.v[j], isWall);
            }
        }
        for (uint32_t v = 0; v < count; ++v) {
            auto& list = neighbours_[v];
            std::sort(list.begin(), list.end());
            list.erase(std::unique(list.begin(), list.end()), list.end());
            if (isFree_[v] != 0 && !list.empty() && nearWall(v)) movable_.push_back(v);
        }
    }

    /// What is next to a wall has to make way for it.
    bool nearWall(uint32_t v) const {
        return std::any_of(tetrasAt_[v].begin(), tetrasAt_[v].end(), [this](uint32_t t) {
            const auto& corners = complex_.tetras[t].v;
            return std::any_of(corners.begin(), corners.end(),
                               [this](uint32_t c) { return piecesAt_[c].size() > 1; });
        });
    }

    /// A vertex follows those where at least its pieces meet; on a wall only along the wall.
    void addNeighbour(uint32_t v, uint32_t other, bool isWall) {
        if (complex_.onSkin(v)) return;
        if (piecesAt_[v].size() > 1 && !isWall) return;
        if (std::includes(piecesAt_[other].begin(), piecesAt_[other].end(), piecesAt_[v].begin(),
                          piecesAt_[v].end()))
            neighbours_[v].push_back(other);
    }

    void move(uint32_t v) {
        glm::dvec3 sum(0.0);
        for (const uint32_t n : neighbours_[v]) sum += glm::dvec3(complex_.positions[n]);
        const glm::dvec3 before = complex_.positions[v];
        const glm::dvec3 way = sum / static_cast<double>(neighbours_[v].size()) - before;
        const double least = std::min(leastAround(v), complex_.rounding);
        for (const double share : {1.0, 0.5, 0.25}) {
            complex_.positions[v] = glm::vec3(before + share * way);
            if (leastAround(v) >= least) return;
        }
        complex_.positions[v] = glm::vec3(before);
    }

    double leastAround(uint32_t v) const {
        const auto at = [&](uint32_t i) { return glm::dvec3(complex_.positions[i]); };
        double least = std::numeric_limits<double>::infinity();
        for (const uint32_t t : tetrasAt_[v]) {
            const auto& c = complex_.tetras[t].v;
            least = std::min(least, leastHeight(at(c[0]), at(c[1]), at(c[2]), at(c[3])));
        }
        return least;
    }

    const InsideLabels& labels_;
    TetraComplex& complex_;
    std::vector<std::vector<uint32_t>> tetrasAt_;  ///< per vertex
    std::vector<Pieces> piecesAt_;                 ///< per vertex, ascending
    std::vector<std::vector<uint32_t>> neighbours_;
    std::vector<uint8_t> isFree_;
    std::vector<uint32_t> movable_;
};

}  // namespace

void tightenWalls(const InsideLabels& labels, TetraComplex& complex) {
    WallTightener(labels, complex).run();
}

}  // namespace sherd
