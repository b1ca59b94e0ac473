// SPDX-License-Identifier: MIT
// What must hold of every map that a reader returns, and the next step on it.
#pragma once

#include <cmath>

#include "fuzzed_promise.h"
#include "map/map_limits.h"
#include "map/planar_map.h"
#include "sherd/baker/fracture_map.h"

namespace sherd::fuzz {

inline void requireQuantity(const std::optional<float>& value) {
    require(!value || (std::isfinite(*value) && *value >= 0), "a quantity is finite, at least 0");
}

inline void requirePromises(const FractureMap& map) {
    require(!map.empty(), "a map that was read has a line");
    for (const FractureMap::Line& line : map.lines) {
        require(line.points.size() >= 2, "a line has two points");
        for (const glm::dvec2 p : line.points)
            require(std::isfinite(p.x) && std::isfinite(p.y), "a point is finite");
        require(line.level >= 1 && line.level <= kMaxMapLevel, "a line has a level");
        requireQuantity(line.properties.strength);
        requireQuantity(line.properties.toughness);
    }
    for (const FractureMap::SurfaceLine& line : map.surfaceLines) {
        require(line.places.size() >= 2, "a surface line has two places");
        require(line.level >= 1 && line.level <= kMaxMapLevel, "a surface line has a level");
    }
    for (const FractureMap::Label& label : map.labels) {
        const glm::dvec3 p = label.place.point;
        require(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z),
                "a label is somewhere");
        require(label.level <= kMaxMapLevel, "a label has a level, or 0");
        require(!label.density || *label.density > 0, "a density is above 0");
        requireQuantity(label.strength);
        requireQuantity(label.toughness);
    }
    for (const std::string& warning : map.warnings)
        require(!warning.empty(), "a warning says what");
}

/// Planarises maps small enough that even if every line crosses every other it takes a moment.
inline void use(const Result<FractureMap>& map) {
    constexpr size_t kMostPoints = 600;
    if (!map) {
        require(!map.error().message.empty(), "an error says what");
        return;
    }
    requirePromises(*map);
    size_t points = 0;
    for (const FractureMap::Line& line : map->lines) points += line.points.size();
    if (points > kMostPoints) return;
    const Result<PlanarMap> planar = planarise(*map);
    if (!planar) return;
    for (const MapEdge& edge : planar->edges)
        require(edge.from != edge.to && edge.from < planar->nodes.size() &&
                    edge.to < planar->nodes.size() && edge.support < planar->supports.size() &&
                    edge.line < map->lines.size(),
                "an edge joins two nodes on its support");
}

}  // namespace sherd::fuzz
