// SPDX-License-Identifier: MIT
#include "levels/wall_fold.h"

#include <algorithm>
#include <map>
#include <utility>

#include "geometry/triangle.h"
#include "levels/level_exposure.h"

namespace sherd {
namespace {

bool isFlat(const HiddenMesh::Face& face) {
    return face.v[0] == face.v[1] || face.v[1] == face.v[2] || face.v[2] == face.v[0];
}

/// Which leaf of which side has the most, against what else there is on that side.
struct Taker {
    size_t side = 0;
    uint32_t leaf = 0;
};

Taker findTaker(const std::vector<HiddenMesh::Face>& faces,
                const std::array<std::vector<uint32_t>, 2>& sides, const PieceModel& model) {
    Taker best;
    double bestRest = 0;
    bool found = false;
    for (size_t side = 0; side < 2; ++side) {
        std::map<uint32_t, double> areas;
        double whole = 0;
        for (const uint32_t f : sides[side]) {
            const double area = triangleArea(model.hidden.positions, faces[f].v);
            areas[faces[f].leaf] += area;
            whole += area;
        }
        for (const auto& [leaf, area] : areas) {
            // A leaf alone folds nothing, whatever rounding makes of its area.
            const double rest = areas.size() == 1 ? 0 : whole - area;
            if (found && rest >= bestRest) continue;
            found = true;
            best = {side, leaf};
            bestRest = rest;
        }
    }
    return best;
}

bool endAlike(const std::vector<HiddenMesh::Face>& faces,
              const std::array<std::vector<uint32_t>, 2>& sides) {
    std::map<std::pair<uint32_t, uint32_t>, int> uses;
    for (const std::vector<uint32_t>& side : sides) {
        for (const uint32_t f : side) {
            for (size_t k = 0; k < 3; ++k) {
                const uint32_t a = faces[f].v[k], b = faces[f].v[(k + 1) % 3];
                if (a != b) uses[std::minmax(a, b)] += a < b ? 1 : -1;
            }
        }
    }
    return std::all_of(uses.begin(), uses.end(), [](const auto& use) { return use.second == 0; });
}

}  // namespace

std::optional<WallFold> foldWall(const std::vector<HiddenMesh::Face>& faces,
                                 const std::array<std::vector<uint32_t>, 2>& sides,
                                 const PieceModel& model) {
    if (sides[0].empty() || sides[1].empty() || !endAlike(faces, sides)) return std::nullopt;
    const Taker taker = findTaker(faces, sides, model);
    const std::vector<uint32_t>& own = sides[taker.side];
    const HiddenMesh::Face& like = faces[*std::find_if(
        own.begin(), own.end(), [&](uint32_t f) { return faces[f].leaf == taker.leaf; })];
    WallFold fold;
    // What the fold is between parts at this level at the earliest.
    fold.exposedFrom = like.exposedFrom == kNotExposed ? kNotExposed : model.components.levels;
    const auto addBack = [&](uint32_t f, uint32_t exposedFrom) {
        if (isFlat(faces[f])) return;
        HiddenMesh::Face back = like;
        back.v = {faces[f].v[0], faces[f].v[2], faces[f].v[1]};
        back.exposedFrom = exposedFrom;
        fold.added.push_back(back);
    };
    for (const uint32_t f : sides[1 - taker.side]) addBack(f, like.exposedFrom);
    for (const uint32_t f : own) {
        if (faces[f].leaf == taker.leaf || isFlat(faces[f])) {
            fold.dropped.push_back(f);
            continue;
        }
        fold.inner.push_back(f);
        addBack(f, fold.exposedFrom);
    }
    return fold;
}

}  // namespace sherd
