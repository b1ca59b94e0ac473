// SPDX-License-Identifier: MIT
#include "solid/site_refinement.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>

namespace sherd {
namespace {

/// Points of a lump's surface, each the farthest from those before (Gonzalez 1985), and from there
/// some of the way in.
void spreadOver(const std::vector<glm::dvec3>& places, const glm::dvec3& core,
                std::vector<glm::dvec3>& sites) {
    constexpr int kSites = 8;
    constexpr double kInwards = 0.3;
    std::vector<double> distance(places.size(), std::numeric_limits<double>::max());
    glm::dvec3 last = core;
    for (int i = 0; i < kSites; ++i) {
        size_t farthest = 0;
        for (size_t p = 0; p < places.size(); ++p) {
            distance[p] = std::min(distance[p], glm::distance(places[p], last));
            if (distance[p] > distance[farthest]) farthest = p;
        }
        if (!(distance[farthest] > 0)) return;
        last = places[farthest];
        sites.push_back(last + kInwards * (core - last));
    }
}

}  // namespace

std::vector<glm::dvec3> sitesForMixedLumps(const TetraComplex& complex, const Components& pieces) {
    std::vector<uint32_t> pieceOf(complex.star.size(), kNone);
    std::vector<uint8_t> mixed(complex.star.size(), 0);
    for (const TetraComplex::Tetra& tetra : complex.tetras) {
        if (tetra.skin == kNone || complex.star[tetra.lump] != 0) continue;
        const uint32_t piece = pieces.leaf[complex.skin.triangles[tetra.skin].parent];
        uint32_t& known = pieceOf[tetra.lump];
        if (known != kNone && known != piece) mixed[tetra.lump] = 1;
        known = piece;
    }
    std::vector<std::vector<glm::dvec3>> places(complex.star.size());
    std::vector<glm::dvec3> cores(complex.star.size());
    for (const TetraComplex::Tetra& tetra : complex.tetras) {
        if (mixed[tetra.lump] == 0) continue;
        const auto at = [&](size_t k) { return glm::dvec3(complex.positions[tetra.v[k]]); };
        places[tetra.lump].push_back((at(0) + at(1) + at(2)) / 3.0);
        cores[tetra.lump] = at(3);
    }
    std::vector<glm::dvec3> sites;
    for (size_t lump = 0; lump < places.size(); ++lump)
        if (mixed[lump] != 0) spreadOver(places[lump], cores[lump], sites);
    return sites;
}

}  // namespace sherd
