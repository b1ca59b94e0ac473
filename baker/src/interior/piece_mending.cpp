// SPDX-License-Identifier: MIT
#include "interior/piece_mending.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "interior/hidden_points.h"
#include "interior/thin_shell.h"
#include "physics/mass_properties.h"

namespace sherd {
namespace {

std::vector<MassProperties> measure(const SplitSurface& surface, const HiddenSheet& sheet,
                                    const Components& components,
                                    std::span<const HiddenFace> faces) {
    std::vector<glm::vec3> positions(surface.positions);
    positions.insert(positions.end(), sheet.points.begin(), sheet.points.end());
    const auto count = static_cast<uint32_t>(surface.positions.size());
    std::vector<std::vector<std::array<uint32_t, 3>>> pieces(components.leafCount);
    for (size_t t = 0; t < surface.triangles.size(); ++t) {
        pieces[components.leaf[t]].push_back(surface.triangles[t].v);
    }
    for (const HiddenFace& face : faces) {
        std::array<uint32_t, 3> ids{};
        for (size_t k = 0; k < 3; ++k) {
            const CornerRef ref = face.corners[k];
            ids[k] = vertexOf(surface, sheet, ref) + (ref.hidden != 0 ? count : 0);
        }
        pieces[face.leaf].push_back(ids);
    }
    std::vector<MassProperties> result;
    result.reserve(pieces.size());
    for (const auto& piece : pieces) result.push_back(massProperties(positions, piece));
    return result;
}

/// Pieces that are no body: without volume, or overlapping themselves so much that no mass has
/// their inertia.
std::vector<uint32_t> emptyLeaves(std::span<const MassProperties> leaves) {
    double total = 0;
    for (const MassProperties& leaf : leaves) total += leaf.volume;
    std::vector<uint32_t> empty;
    for (uint32_t leaf = 0; leaf < leaves.size(); ++leaf) {
        // Below this share a volume is rounding, and no engine can simulate it.
        if (!(leaves[leaf].volume > 1e-9 * total && isPhysical(leaves[leaf])))
            empty.push_back(leaf);
    }
    return empty;
}

/// Moves the hidden points of the given leaves half way to the surface.
void thin(const Components& components, const SolidTest& object, std::span<const uint32_t> leaves,
          HiddenSheet& sheet) {
    std::vector<uint8_t> chosen(components.leafCount, 0);
    for (const uint32_t leaf : leaves) chosen[leaf] = 1;
    std::vector<uint8_t> moved(sheet.points.size(), 0);
    for (const HiddenSheet::Triangle& t : sheet.triangles) {
        if (chosen[components.leaf[t.parent]] == 0) continue;
        for (const uint32_t v : t.v) {
            if (moved[v] != 0) continue;
            moved[v] = 1;
            const glm::dvec3 p(sheet.feet[v]);
            sheet.points[v] = pullInside(object, sheet.feet[v],
                                         glm::vec3((p + glm::dvec3(sheet.points[v])) * 0.5));
        }
    }
}

/// Gives the pieces a shell: a share of the way through the solid, no deeper than the piece is
/// wide.
void shell(const SplitSurface& surface, const Components& components, const ThinShell& below,
           std::span<const uint32_t> leaves, double share, HiddenSheet& sheet) {
    const std::vector<double> areas = leafAreas(surface, components);
    std::vector<double> deepest(components.leafCount, 0);
    for (const uint32_t leaf : leaves) deepest[leaf] = 0.25 * std::sqrt(areas[leaf]);
    std::vector<double> reach(sheet.points.size(), 0);
    for (const HiddenSheet::Triangle& t : sheet.triangles) {
        for (const uint32_t v : t.v)
            reach[v] = std::max(reach[v], deepest[components.leaf[t.parent]]);
    }
    for (uint32_t v = 0; v < reach.size(); ++v)
        if (reach[v] > 0) sheet.points[v] = below.below(v, share, reach[v]);
}

}  // namespace

MendedPieces mendPieces(const SplitSurface& surface, const MeshTopology& topology,
                        const SolidTest& object, unsigned threads, HiddenSheet& sheet,
                        Components& components, const SolidLeaves& solid) {
    MendedPieces result;
    result.faces = stitch(surface, topology, sheet, components, solid);
    std::vector<MassProperties> leaves;
    std::vector<uint32_t> empty;
    const auto settle = [&] {
        const Containment done = keepInside(object, surface, result.faces, threads, sheet);
        result.containment.pulled += done.pulled;
        result.containment.protruding = done.protruding;
        leaves = measure(surface, sheet, components, result.faces);
        empty = emptyLeaves(leaves);
    };
    settle();
    result.thinned = static_cast<uint32_t>(empty.size());
    for (int round = 0; round < 6 && !empty.empty(); ++round) {
        thin(components, object, empty, sheet);
        settle();
    }
    if (!empty.empty()) {
        const ThinShell below(sheet, object);
        const auto before = static_cast<uint32_t>(empty.size());
        for (const double share : {0.4, 0.1, 0.02}) {
            if (empty.empty()) break;
            shell(surface, components, below, empty, share, sheet);
            settle();
        }
        result.shelled = before - std::min(before, static_cast<uint32_t>(empty.size()));
    }
    while (!empty.empty() && components.leafCount > 1) {
        const std::vector<uint32_t> best = bestNeighbours(surface, topology, components);
        const auto largest = static_cast<uint32_t>(
            std::max_element(leaves.begin(), leaves.end(),
                             [](const auto& a, const auto& b) { return a.volume < b.volume; }) -
            leaves.begin());
        std::vector<uint32_t> into(components.leafCount);
        std::iota(into.begin(), into.end(), 0U);
        const std::vector<MergedLeaf> places = placesOfLeaves(surface, components);
        bool changed = false;
        for (const uint32_t leaf : empty) {
            // A closed part turned inwards is a hollow in the part around it.
            into[leaf] = best[leaf] == kNone ? largest : best[leaf];
            if (into[leaf] == leaf) continue;
            result.merged.push_back(places[leaf]);
            changed = true;
        }
        if (!changed) break;
        mergeLeaves(components, into);
        if (!solid.solid.empty()) {
            result.stale = true;
            return result;
        }
        result.faces = stitch(surface, topology, sheet, components);
        leaves = measure(surface, sheet, components, result.faces);
        empty = emptyLeaves(leaves);
    }
    result.empty = static_cast<uint32_t>(empty.size());
    return result;
}

}  // namespace sherd
