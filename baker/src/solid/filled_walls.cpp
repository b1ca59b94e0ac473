// SPDX-License-Identifier: MIT
#include "solid/filled_walls.h"

#include <algorithm>
#include <map>

#include "geometry/union_find.h"
#include "solid/inside_labels.h"
#include "solid/site_refinement.h"
#include "solid/wall_tightening.h"
#include "volume/volume_sites.h"

namespace sherd {
namespace {

using Tetra = TetraComplex::Tetra;

/// In the volume of the object; their size is that of the facets of broken faces.
constexpr uint32_t kCells = 300;
/// Of smaller cells where those are too large.
constexpr int kRounds = 6;
/// Each becomes about eight tetrahedra of 300 bytes with all that is known of them.
constexpr size_t kMostTriangles = 500'000;

class WallMaker {
  public:
    WallMaker(const TetraComplex& complex, const InsideLabels& labels)
        : complex_(complex),
          labels_(labels),
          fans_(4 * complex.tetras.size()),
          hub_(complex.positions.size(), kNone) {}

    FilledWalls run(const SplitSurface& surface) {
        findFans();
        FilledWalls result;
        result.divided = divideEdges(surface, complex_.skin, wantedVertices());
        divided_ = &result.divided;
        findCorners();
        for (uint32_t t = 0; t < complex_.tetras.size(); ++t) {
            for (size_t face = 0; face < 4; ++face) {
                const uint32_t across = complex_.tetras[t].across[face];
                if (across != kNone && labels_.piece[across] < labels_.piece[t])
                    addTriangle(t, face, across);
            }
        }
        result.walls.filled = true;
        result.walls.hubs = std::move(hubs_);
        for (auto& [pieces, wall] : walls_) result.walls.walls.push_back(std::move(wall));
        for (const uint8_t broken : labels_.broken)
            result.walls.solid.push_back(broken == 0 ? 1 : 0);
        return result;
    }

  private:
    void findFans() {
        for (uint32_t t = 0; t < complex_.tetras.size(); ++t) {
            const Tetra& tetra = complex_.tetras[t];
            for (size_t face = 0; face < 4; ++face) {
                const uint32_t across = tetra.across[face];
                if (across == kNone || labels_.piece[across] != labels_.piece[t]) continue;
                for (const size_t k : kTetraFaces[face]) {
                    const size_t i = cornerOf(across, tetra.v[k]);
                    if (i < 4)
                        fans_.unite(4 * t + static_cast<uint32_t>(k),
                                    4 * across + static_cast<uint32_t>(i));
                }
            }
        }
    }

    size_t cornerOf(uint32_t t, uint32_t vertex) const {
        const auto& v = complex_.tetras[t].v;
        return static_cast<size_t>(std::find(v.begin(), v.end(), vertex) - v.begin());
    }

    /// Of the skin: where walls end.
    std::vector<uint8_t> wantedVertices() const {
        std::vector<uint8_t> wanted(complex_.skin.positions.size(), 0);
        for (uint32_t t = 0; t < complex_.tetras.size(); ++t) {
            for (size_t face = 0; face < 4; ++face) {
                const uint32_t across = complex_.tetras[t].across[face];
                if (across == kNone || labels_.piece[across] == labels_.piece[t]) continue;
                for (const size_t k : kTetraFaces[face])
                    if (complex_.onSkin(complex_.tetras[t].v[k]))
                        wanted[complex_.tetras[t].v[k]] = 1;
            }
        }
        return wanted;
    }

    /// A corner of the surface for every vertex of it in every piece.
    void findCorners() {
        corner_.assign(4 * complex_.tetras.size(), kNone);
        for (uint32_t t = 0; t < complex_.tetras.size(); ++t) {
            const Tetra& tetra = complex_.tetras[t];
            if (tetra.skin == kNone) continue;
            const uint32_t parent = complex_.skin.triangles[tetra.skin].parent;
            for (uint32_t k = 0; k < 3; ++k) {
                const uint32_t vertex = divided_->vertexOfCut[tetra.v[k]];
                if (vertex == kNone) continue;
                uint32_t& corner = corner_[fans_.find(4 * t + k)];
                if (corner == kNone) corner = cornerIn(parent, vertex);
            }
        }
    }

    uint32_t cornerIn(uint32_t parent, uint32_t vertex) const {
        for (uint32_t c = 3 * divided_->firstOf[parent]; c < 3 * divided_->firstOf[parent + 1]; ++c)
            if (divided_->surface.triangles[c / 3].v[c % 3] == vertex) return c;
        return kNone;
    }

    uint32_t cornerAt(uint32_t t, uint32_t vertex) {
        const size_t k = cornerOf(t, vertex);
        return k < 4 ? corner_[fans_.find(4 * t + static_cast<uint32_t>(k))] : kNone;
    }

    void addTriangle(uint32_t high, size_t face, uint32_t low) {
        std::array<OutlineVertex, 3> triangle;
        for (size_t i = 0; i < 3; ++i) {
            const uint32_t vertex = complex_.tetras[high].v[kTetraFaces[face][i]];
            OutlineVertex& v = triangle[i];
            if (complex_.onSkin(vertex)) {
                v.vertex = divided_->vertexOfCut[vertex];
                v.lowCorner = cornerAt(low, vertex);
                v.highCorner = cornerAt(high, vertex);
            }
            if (v.lowCorner == kNone || v.highCorner == kNone) v.hub = hubOf(vertex);
        }
        const std::pair key(labels_.piece[low], labels_.piece[high]);
        SolidWall& wall = walls_[key];
        wall.low = key.first;
        wall.high = key.second;
        wall.triangles.push_back(triangle);
    }

    uint32_t hubOf(uint32_t vertex) {
        if (hub_[vertex] == kNone) {
            hub_[vertex] = static_cast<uint32_t>(hubs_.size());
            hubs_.push_back(complex_.positions[vertex]);
        }
        return hub_[vertex];
    }

    const TetraComplex& complex_;
    const InsideLabels& labels_;
    const DividedSurface* divided_ = nullptr;
    UnionFind fans_;                ///< corners of tetrahedra that hang together in a piece
    std::vector<uint32_t> corner_;  ///< per fan, by its lowest: a corner of the surface
    std::vector<uint32_t> hub_;     ///< per vertex of the complex
    std::vector<glm::vec3> hubs_;
    std::map<std::pair<uint32_t, uint32_t>, SolidWall> walls_;
};

/// Filled with cells that are small enough wherever several pieces come to one.
std::optional<TetraComplex> fillFor(const SplitSurface& surface, const Components& pieces) {
    VolumeSites options;
    options.kind = VolumeSites::Kind::lattice;
    options.count = kCells;
    const auto spread = volumeSites(surface.positions, vertexTriangles(surface), options);
    if (!spread) return std::nullopt;
    std::vector<glm::dvec3> sites = *spread;
    std::optional<TetraComplex> complex = fillWithTetras(surface, sites);
    for (int round = 0; complex && round < kRounds; ++round) {
        const std::vector<glm::dvec3> more = sitesForMixedLumps(*complex, pieces);
        if (more.empty()) break;
        sites.insert(sites.end(), more.begin(), more.end());
        complex = fillWithTetras(surface, sites);
    }
    return complex;
}

}  // namespace

std::optional<FilledWalls> filledWalls(const SplitSurface& surface, const Components& pieces) {
    if (surface.triangles.size() > kMostTriangles) return std::nullopt;
    std::optional<TetraComplex> complex = fillFor(surface, pieces);
    if (!complex) return std::nullopt;
    const InsideLabels labels = labelInside(*complex, surface, pieces);
    tightenWalls(labels, *complex);
    return WallMaker(*complex, labels).run(surface);
}

}  // namespace sherd
