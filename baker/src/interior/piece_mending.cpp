// SPDX-License-Identifier: MIT
#include "interior/piece_mending.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <numeric>

#include "interior/hidden_points.h"

namespace sherd {
namespace {

std::vector<double> volumes(const SplitSurface& surface, const Components& components,
                            std::span<const HiddenFace> faces, std::span<const glm::vec3> hidden) {
    // Seen from a vertex of the leaf itself: far from the origin nothing cancels.
    std::vector<glm::dvec3> origin(components.leafCount);
    for (size_t t = surface.triangles.size(); t-- > 0;) {
        origin[components.leaf[t]] = surface.positions[surface.triangles[t].v[0]];
    }
    std::vector<double> sixfold(components.leafCount, 0);
    const auto add = [&](uint32_t leaf, const glm::vec3& a, const glm::vec3& b,
                         const glm::vec3& c) {
        const glm::dvec3 o = origin[leaf];
        sixfold[leaf] +=
            glm::dot(glm::dvec3(a) - o, glm::cross(glm::dvec3(b) - o, glm::dvec3(c) - o));
    };
    for (size_t t = 0; t < surface.triangles.size(); ++t) {
        const auto& v = surface.triangles[t].v;
        add(components.leaf[t], surface.positions[v[0]], surface.positions[v[1]],
            surface.positions[v[2]]);
    }
    const auto place = [&](CornerRef ref) {
        const uint32_t v = surface.triangles[ref.corner / 3].v[ref.corner % 3];
        return ref.hidden != 0 ? hidden[v] : surface.positions[v];
    };
    for (const HiddenFace& face : faces) {
        add(face.leaf, place(face.corners[0]), place(face.corners[1]), place(face.corners[2]));
    }
    for (double& v : sixfold) v /= 6;
    return sixfold;
}

std::vector<uint32_t> emptyLeaves(std::span<const double> leafVolumes) {
    const double total = std::accumulate(leafVolumes.begin(), leafVolumes.end(), 0.0);
    std::vector<uint32_t> empty;
    for (uint32_t leaf = 0; leaf < leafVolumes.size(); ++leaf) {
        // Below this share a volume is rounding, and no engine can simulate it.
        if (!(leafVolumes[leaf] > 1e-9 * total)) empty.push_back(leaf);
    }
    return empty;
}

/// Moves the hidden points of the given leaves half way to the surface.
void thin(const SplitSurface& surface, const Components& components, const InsideTest& inside,
          std::span<const uint32_t> leaves, std::vector<glm::vec3>& hidden) {
    std::vector<uint8_t> chosen(components.leafCount, 0);
    for (const uint32_t leaf : leaves) chosen[leaf] = 1;
    std::vector<uint8_t> moved(surface.positions.size(), 0);
    for (size_t t = 0; t < surface.triangles.size(); ++t) {
        if (chosen[components.leaf[t]] == 0) continue;
        for (const uint32_t v : surface.triangles[t].v) {
            if (moved[v] != 0) continue;
            moved[v] = 1;
            const glm::vec3& p = surface.positions[v];
            hidden[v] =
                pullInside(inside, p, glm::vec3((glm::dvec3(p) + glm::dvec3(hidden[v])) * 0.5));
        }
    }
}

}  // namespace

MendedPieces mendPieces(const SplitSurface& surface, const MeshTopology& topology,
                        const InsideTest& inside, std::vector<glm::vec3>& hidden,
                        Components& components) {
    MendedPieces result;
    result.faces = stitch(surface, topology, components);
    result.leafVolumes = volumes(surface, components, result.faces, hidden);
    std::vector<uint32_t> empty = emptyLeaves(result.leafVolumes);
    result.thinned = static_cast<uint32_t>(empty.size());
    for (int round = 0; round < 6 && !empty.empty(); ++round) {
        thin(surface, components, inside, empty, hidden);
        result.leafVolumes = volumes(surface, components, result.faces, hidden);
        empty = emptyLeaves(result.leafVolumes);
    }
    while (!empty.empty() && components.leafCount > 1) {
        const std::vector<uint32_t> best = bestNeighbours(surface, topology, components);
        const auto largest = static_cast<uint32_t>(
            std::max_element(result.leafVolumes.begin(), result.leafVolumes.end()) -
            result.leafVolumes.begin());
        std::vector<uint32_t> into(components.leafCount);
        std::iota(into.begin(), into.end(), 0U);
        const std::vector<double> areas = leafAreas(surface, components);
        bool changed = false;
        for (const uint32_t leaf : empty) {
            // A closed part turned inwards is a hollow in the part around it.
            into[leaf] = best[leaf] == kNone ? largest : best[leaf];
            if (into[leaf] == leaf) continue;
            result.merged.push_back({areas[leaf], placeOfLeaf(surface, components, leaf)});
            changed = true;
        }
        if (!changed) break;
        mergeLeaves(components, into);
        result.faces = stitch(surface, topology, components);
        result.leafVolumes = volumes(surface, components, result.faces, hidden);
        empty = emptyLeaves(result.leafVolumes);
    }
    return result;
}

}  // namespace sherd
