// SPDX-License-Identifier: MIT
// A fracture set of given pieces, as far as colliders look at it.
#pragma once

#include <array>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <vector>

#include "sherd/formats/fracture_set.h"

namespace sherd::test {

struct PieceMesh {
    std::vector<glm::vec3> positions;
    std::vector<std::array<uint32_t, 3>> triangles;
};

/// The unit cubes at these places as one closed mesh, faces between them left out, moved and
/// scaled.
inline PieceMesh cubes(const std::vector<std::array<int, 3>>& places, float scale = 1) {
    PieceMesh out;
    std::map<std::array<int, 3>, uint32_t> corners;
    const auto corner = [&](std::array<int, 3> at) {
        const auto [it, isNew] = corners.emplace(at, uint32_t(out.positions.size()));
        if (isNew) out.positions.push_back(scale * glm::vec3(at[0], at[1], at[2]));
        return it->second;
    };
    const auto full = [&](const std::array<int, 3>& at) {
        for (const auto& place : places)
            if (place == at) return true;
        return false;
    };
    for (const auto& place : places) {
        for (size_t axis = 0; axis < 3; ++axis) {
            for (const int side : {0, 1}) {
                std::array<int, 3> beside = place;
                beside[axis] += side == 1 ? 1 : -1;
                if (full(beside)) continue;
                std::array<uint32_t, 4> loop{};
                for (size_t k = 0; k < 4; ++k) {
                    std::array<int, 3> at = place;
                    at[axis] += side;
                    at[(axis + 1) % 3] += k == 1 || k == 2 ? 1 : 0;
                    at[(axis + 2) % 3] += k >= 2 ? 1 : 0;
                    loop[k] = corner(at);
                }
                if (side == 0) std::swap(loop[1], loop[3]);
                out.triangles.push_back({loop[0], loop[1], loop[2]});
                out.triangles.push_back({loop[0], loop[2], loop[3]});
            }
        }
    }
    return out;
}

/// Fragment 0 is all pieces together, 1 and following are the pieces. Their surfaces are visible.
inline FractureSet setOf(const std::vector<PieceMesh>& pieces) {
    FractureSet set;
    const auto count = static_cast<uint32_t>(pieces.size());
    set.fragments.resize(count + 1);
    set.fragments[0].children = {1, count};
    set.levels = {{{0, 1}, ""}, {{1, count}, ""}};
    set.materials = {-1};
    std::vector<Range> ranges;
    double whole = 0;
    for (uint32_t f = 1; f <= count; ++f) {
        const PieceMesh& piece = pieces[f - 1];
        const auto first = static_cast<uint32_t>(set.geometry.positions.size());
        set.geometry.positions.insert(set.geometry.positions.end(), piece.positions.begin(),
                                      piece.positions.end());
        ranges.push_back({static_cast<uint32_t>(set.geometry.indices.size()),
                          static_cast<uint32_t>(3 * piece.triangles.size())});
        double volume = 0;
        for (const auto& t : piece.triangles) {
            for (const uint32_t v : t) set.geometry.indices.push_back(first + v);
            volume += glm::dot(glm::dvec3(piece.positions[t[0]]),
                               glm::cross(glm::dvec3(piece.positions[t[1]]),
                                          glm::dvec3(piece.positions[t[2]]))) /
                      6;
        }
        Fragment& fragment = set.fragments[f];
        fragment.parent = 0;
        fragment.level = 1;
        fragment.volume = static_cast<float>(volume);
        whole += volume;
    }
    set.fragments[0].volume = static_cast<float>(whole);
    const auto indices = static_cast<uint32_t>(set.geometry.indices.size());
    set.geometry.primitives.push_back({0, 0, {0, indices}, false});
    set.fragmentRanges.push_back({0, indices});
    set.fragmentRanges.insert(set.fragmentRanges.end(), ranges.begin(), ranges.end());
    return set;
}

}  // namespace sherd::test
