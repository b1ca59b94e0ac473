// SPDX-License-Identifier: MIT
#include "levels/wall_exposure.h"

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>

namespace sherd {
namespace {

struct Side {
    std::array<uint32_t, 3> corners;  ///< places, ascending
    uint32_t face;
    bool even;  ///< whether the face turns as the corners do
    bool operator<(const Side& o) const {
        return std::tie(corners, face) < std::tie(o.corners, o.face);
    }
};

std::vector<Side> sidesOf(const PieceModel& model) {
    const std::vector<uint32_t> places = placesOf(model);
    std::vector<Side> sides;
    for (uint32_t f = 0; f < model.hidden.faces.size(); ++f) {
        std::array<uint32_t, 3> v{};
        for (size_t k = 0; k < 3; ++k) v[k] = places[model.hidden.faces[f].v[k]];
        if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) continue;
        std::rotate(v.begin(), std::min_element(v.begin(), v.end()), v.end());
        const bool even = v[1] < v[2];
        if (!even) std::swap(v[1], v[2]);
        sides.push_back({v, f, even});
    }
    std::sort(sides.begin(), sides.end());
    return sides;
}

/// Per face the one that lies on it the other way round in another leaf, or kNone.
std::vector<uint32_t> facesAcross(const PieceModel& model) {
    const std::vector<Side> sides = sidesOf(model);
    const std::vector<HiddenMesh::Face>& faces = model.hidden.faces;
    std::vector<uint32_t> across(faces.size(), kNone);
    for (size_t first = 0, last = 0; first < sides.size(); first = last) {
        while (last < sides.size() && sides[last].corners == sides[first].corners) ++last;
        for (size_t i = first; i < last; ++i) {
            for (size_t j = i + 1; j < last && across[sides[i].face] == kNone; ++j) {
                const uint32_t a = sides[i].face, b = sides[j].face;
                if (across[b] != kNone || sides[i].even == sides[j].even ||
                    faces[a].leaf == faces[b].leaf || faces[a].exposedFrom != faces[b].exposedFrom)
                    continue;
                across[a] = b;
                across[b] = a;
            }
        }
    }
    return across;
}

}  // namespace

void exposeBetween(const std::vector<LevelSpan>& spans, const PieceModel& model) {
    const std::vector<uint32_t> across = facesAcross(model);
    std::vector<HiddenMesh::Face>& faces = model.hidden.faces;
    for (size_t f = 0; f < faces.size(); ++f) {
        HiddenMesh::Face& face = faces[f];
        const LevelSpan& span = spans[face.exposedFrom];
        face.exposedFrom =
            across[f] == kNone
                ? span.first
                : std::clamp(model.components.separatedFrom(face.leaf, faces[across[f]].leaf),
                             span.first, span.last);
        face.fragment = model.components.at(face.exposedFrom, face.leaf);
    }
}

}  // namespace sherd
