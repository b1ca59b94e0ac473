// SPDX-License-Identifier: MIT
// Which two triangles meet at each use of an edge.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace sherd {

struct PairingInput {
    std::span<const std::array<uint32_t, 3>> triangles;  ///< closed over vertex ids
    std::function<glm::vec3(uint32_t)> position;         ///< of a vertex
    /// Where an edge is used more than once, triangles of the same sheet go together, then those of
    /// the same layer (the low half of `sheet`); 0: of none.
    std::function<uint64_t(uint32_t)> sheet;
};

/// For each half edge 3 t + k the one it meets, which runs against it. An edge used several times
/// in each direction is where a solid touches itself: its uses go together by sheet, then so that
/// each two bound one wedge of the inside.
struct EdgePairs {
    static constexpr uint32_t kNone = 0xFFFFFFFFU;
    std::vector<uint32_t> twins;  ///< kNone: the edge is open
    std::vector<uint32_t>
        repeated;  ///< of edges used several times: the half edges of one direction
};
EdgePairs pairEdges(const PairingInput& input);

}  // namespace sherd
