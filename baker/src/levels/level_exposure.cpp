// SPDX-License-Identifier: MIT
#include "levels/level_exposure.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "geometry/closed_mesh.h"
#include "geometry/compact_labels.h"
#include "levels/leaf_cut.h"

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

uint32_t showOpenPieces(const PieceModel& model) {
    const Components& components = model.components;
    std::vector<HiddenMesh::Face>& hidden = model.hidden.faces;
    const auto outer = static_cast<uint32_t>(model.surface.triangles.size());
    const std::vector<std::vector<uint32_t>> ofLeaf = facesOfLeaves(model);
    uint32_t count = 0;
    for (uint32_t level = 1; level <= components.levels; ++level) {
        std::vector<std::vector<uint32_t>> faces(components.count[level - 1]);
        for (uint32_t leaf = 0; leaf < components.leafCount; ++leaf) {
            std::vector<uint32_t>& all = faces[components.at(level, leaf)];
            all.insert(all.end(), ofLeaf[leaf].begin(), ofLeaf[leaf].end());
        }
        for (const std::vector<uint32_t>& piece : faces) {
            std::vector<std::array<uint32_t, 3>> shown;
            for (const uint32_t f : piece) {
                if (f < outer)
                    shown.push_back(model.surface.triangles[f].v);
                else if (hidden[f - outer].exposedFrom <= level)
                    shown.push_back(hidden[f - outer].v);
            }
            if (proveByPositions(model.hidden.positions, shown).closed()) continue;
            ++count;
            for (const uint32_t f : piece)
                if (f >= outer)
                    hidden[f - outer].exposedFrom = std::min(hidden[f - outer].exposedFrom, level);
        }
    }
    return count;
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
