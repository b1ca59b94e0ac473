// SPDX-License-Identifier: MIT
#include "levels/level_exposure.h"

#include <algorithm>
#include <map>
#include <utility>

#include "geometry/compact_labels.h"

namespace sherd {

std::vector<uint32_t> otherSides(const PieceModel& model) {
    using Triangle = std::array<uint32_t, 3>;
    const std::vector<HiddenMesh::Face>& faces = model.hidden.faces;
    const std::vector<uint32_t> places = placesOf(model);
    const Components& components = model.components;
    std::vector<uint32_t> other(faces.size(), kNone);
    std::map<Triangle, std::vector<uint32_t>> open;  // by places, from the lowest on: faces
    for (uint32_t f = 0; f < faces.size(); ++f) {
        if (faces[f].exposedFrom != kNotExposed) continue;
        Triangle v{places[faces[f].v[0]], places[faces[f].v[1]], places[faces[f].v[2]]};
        if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) continue;
        std::rotate(v.begin(), std::min_element(v.begin(), v.end()), v.end());
        std::vector<uint32_t>& back = open[{v[0], v[2], v[1]}];
        // Where several walls are in one place, of leaves that are still together first.
        const auto isNear = [&](uint32_t g) {
            return components.at(components.levels, faces[g].leaf) ==
                   components.at(components.levels, faces[f].leaf);
        };
        const auto isOther = [&](uint32_t g) { return faces[g].leaf != faces[f].leaf; };
        auto found = std::find_if(back.begin(), back.end(),
                                  [&](uint32_t g) { return isOther(g) && isNear(g); });
        if (found == back.end()) found = std::find_if(back.begin(), back.end(), isOther);
        if (found == back.end()) {
            open[v].push_back(f);
            continue;
        }
        other[f] = *found;
        other[*found] = f;
        back.erase(found);
    }
    return other;
}

void exposeWalls(const PieceModel& model) {
    std::vector<HiddenMesh::Face>& faces = model.hidden.faces;
    const Components& components = model.components;
    const auto isHidden = [](const HiddenMesh::Face& f) { return f.exposedFrom == kNotExposed; };
    if (std::none_of(faces.begin(), faces.end(), isHidden)) return;
    const std::vector<uint32_t> other = otherSides(model);
    const auto pieceOf = [&](uint32_t f) {
        return components.at(components.levels, faces[f].leaf);
    };
    for (uint32_t f = 0; f < faces.size(); ++f) {
        if (faces[f].exposedFrom != kNotExposed) continue;
        if (other[f] == kNone || pieceOf(other[f]) != pieceOf(f))
            faces[f].exposedFrom = components.levels;
    }
}

void mergeClasses(const std::vector<uint32_t>& classOfLeaf, const PieceModel& model) {
    const std::vector<uint32_t> other = otherSides(model);
    Components& components = model.components;
    std::vector<HiddenMesh::Face> kept;
    for (uint32_t f = 0; f < other.size(); ++f) {
        const HiddenMesh::Face& face = model.hidden.faces[f];
        if (other[f] == kNone ||
            classOfLeaf[face.leaf] != classOfLeaf[model.hidden.faces[other[f]].leaf])
            kept.push_back(face);
    }
    model.hidden.faces = std::move(kept);
    const std::vector<uint32_t> now = compactLabels(classOfLeaf, components.leafCount);
    for (HiddenMesh::Face& face : model.hidden.faces) face.leaf = now[face.leaf];
    for (uint32_t& leaf : components.leaf) leaf = now[leaf];
    for (std::vector<uint32_t>& ofLeaf : components.ofLeaf) {
        std::vector<uint32_t> labels(components.leafCount);
        for (size_t leaf = 0; leaf < now.size(); ++leaf) labels[now[leaf]] = ofLeaf[leaf];
        ofLeaf = std::move(labels);
    }
}

}  // namespace sherd
