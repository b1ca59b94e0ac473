// SPDX-License-Identifier: MIT
// Proofs that triangles close.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>

namespace sherd {

struct ClosedReport {
    uint32_t openEdges = 0;      ///< directed edges without as many reverses
    uint32_t repeatedEdges = 0;  ///< balanced, but used more than once in a direction
    uint32_t splitFans = 0;      ///< vertices whose triangles do not form one fan
    bool closed() const { return openEdges == 0; }
    bool manifold() const { return openEdges == 0 && repeatedEdges == 0 && splitFans == 0; }
};

/// Over vertex ids: every edge once in each direction, every vertex one fan. Ids need not be dense.
ClosedReport proveByIds(std::span<const std::array<uint32_t, 3>> triangles);

/// Over vertex ids: whether every directed edge is used as often as its reverse. By a sum of
/// hashes, so that a surface that is open passes once in 2^64 times, in a tenth of the time of a
/// proof.
bool edgesCancel(std::span<const std::array<uint32_t, 3>> triangles);

/// Over bit-equal positions (-0 equals 0), triangles with a repeated position dropped: every
/// directed edge is used as often as its reverse. Only openEdges is filled.
ClosedReport proveByPositions(std::span<const glm::vec3> positions,
                              std::span<const std::array<uint32_t, 3>> triangles);

/// Signed volume: sums of tetrahedra seen from `origin` (choose it nearby, against cancellation).
double signedVolume(std::span<const glm::vec3> positions,
                    std::span<const std::array<uint32_t, 3>> triangles, const glm::dvec3& origin);

}  // namespace sherd
