// SPDX-License-Identifier: MIT
#include "surface/component_merging.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <map>
#include <numeric>

#include "geometry/compact_labels.h"
#include "geometry/triangle.h"

namespace sherd {
namespace {

/// Where a chain of merges ends; small leaves may have chosen each other in a circle, whose lowest
/// one then stands for all.
uint32_t rootOf(std::span<const uint32_t> into, uint32_t leaf) {
    std::vector<uint32_t> path{leaf};
    while (into[leaf] != leaf) {
        leaf = into[leaf];
        const auto seen = std::find(path.begin(), path.end(), leaf);
        if (seen != path.end()) return *std::min_element(seen, path.end());
        path.push_back(leaf);
    }
    return leaf;
}

}  // namespace

std::vector<uint32_t> bestNeighbours(const SplitSurface& surface, const MeshTopology& topology,
                                     const Components& components) {
    std::vector<std::map<uint32_t, double>> border(components.leafCount);
    for (uint32_t h = 0; h < 3 * surface.triangles.size(); ++h) {
        const uint32_t o = topology.opposite[h];
        if (o == kNone) continue;
        const uint32_t a = components.leaf[h / 3];
        const uint32_t b = components.leaf[o / 3];
        if (a == b) continue;
        border[a][b] += edgeLength(surface, h);
    }
    std::vector<uint32_t> best(components.leafCount, kNone);
    for (uint32_t leaf = 0; leaf < components.leafCount; ++leaf) {
        uint32_t bestLevel = 0;
        double bestLength = -1;
        for (const auto& [neighbour, length] : border[leaf]) {
            const uint32_t level = components.separatedFrom(leaf, neighbour);
            if (level < bestLevel || (level == bestLevel && length <= bestLength)) continue;
            best[leaf] = neighbour;
            bestLevel = level;
            bestLength = length;
        }
    }
    return best;
}

void mergeLeaves(Components& components, std::span<const uint32_t> into) {
    std::vector<uint32_t> root(components.leafCount);
    for (uint32_t leaf = 0; leaf < components.leafCount; ++leaf) root[leaf] = rootOf(into, leaf);
    for (uint32_t& leaf : components.leaf) leaf = root[leaf];
    std::vector<uint32_t> old = components.leaf;  // old leaf per triangle, numbered anew below
    std::vector<uint32_t> oldOfNew;
    std::vector<uint8_t> seen(components.leafCount, 0);
    for (const uint32_t leaf : old) {
        if (seen[leaf] == 0) oldOfNew.push_back(leaf);
        seen[leaf] = 1;
    }
    components.leaf = compactLabels(components.leaf, components.leafCount);
    for (uint32_t k = 0; k < components.levels; ++k) {
        std::vector<uint32_t> labels;
        labels.reserve(oldOfNew.size());
        for (const uint32_t leaf : oldOfNew) labels.push_back(components.ofLeaf[k][leaf]);
        components.ofLeaf[k] = compactLabels(labels, components.count[k]);
    }
}

std::vector<double> leafAreas(const SplitSurface& surface, const Components& components) {
    std::vector<double> areas(components.leafCount, 0);
    for (size_t t = 0; t < surface.triangles.size(); ++t) {
        areas[components.leaf[t]] += triangleArea(surface.positions, surface.triangles[t].v);
    }
    return areas;
}

std::vector<MergedLeaf> placesOfLeaves(const SplitSurface& surface, const Components& components) {
    std::vector<double> largest(components.leafCount, -1);
    std::vector<MergedLeaf> places(components.leafCount);
    for (uint32_t t = 0; t < surface.triangles.size(); ++t) {
        const auto& triangle = surface.triangles[t];
        const uint32_t leaf = components.leaf[t];
        const double area = triangleArea(surface.positions, triangle.v);
        places[leaf].area += area;
        if (area <= largest[leaf]) continue;
        largest[leaf] = area;
        places[leaf].source = triangle.source;
        places[leaf].position = centroidOf(surface, t);
    }
    return places;
}

std::vector<MergedLeaf> mergeSmallLeaves(const SplitSurface& surface, const MeshTopology& topology,
                                         double minimumShare, Components& components) {
    std::vector<MergedLeaf> merged;
    for (bool again = true; again;) {
        again = false;
        const std::vector<double> areas = leafAreas(surface, components);
        const double total = std::accumulate(areas.begin(), areas.end(), 0.0);
        std::vector<uint32_t> into(components.leafCount);
        std::iota(into.begin(), into.end(), 0U);
        std::vector<uint32_t> best;
        std::vector<MergedLeaf> places;
        for (uint32_t leaf = 0; leaf < components.leafCount; ++leaf) {
            if (areas[leaf] >= minimumShare * total) continue;
            if (best.empty()) {
                best = bestNeighbours(surface, topology, components);
                places = placesOfLeaves(surface, components);
            }
            if (best[leaf] == kNone) continue;
            into[leaf] = best[leaf];
            merged.push_back(places[leaf]);
            again = true;
        }
        if (again) mergeLeaves(components, into);
    }
    return merged;
}

}  // namespace sherd
