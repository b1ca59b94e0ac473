// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <random>
#include <span>
#include <vector>

#include "solid/tetra_complex.h"
#include "surface/components.h"

namespace sherd {

/// Around every edge inside, the tetrahedra of a fragment are to follow each other: else it would
/// meet itself there. Where they do not, at any level, some change hands.
class FanRepair {
  public:
    /// fixed: tetrahedra that must stay; piece: of each. The arguments must outlive it.
    FanRepair(const TetraComplex& complex, const Components& pieces, std::span<const uint8_t> fixed,
              std::span<uint32_t> piece);

    /// Returns the number of edges where a fragment still meets itself.
    uint32_t run();

  private:
    /// Tetrahedra that change hands together.
    struct Move {
        std::vector<uint32_t> tetras;
        uint32_t to = 0;
    };
    /// Tetrahedra in the order in which they follow each other around an edge.
    using Ring = std::span<const uint32_t>;

    void findRings();
    void follow(uint32_t start, uint32_t a, uint32_t b);
    Ring ringOf(uint32_t number) const;
    uint32_t excess(Ring ring) const;
    uint32_t excessAt(uint32_t level, Ring ring) const;
    bool repair(Ring ring);
    std::vector<Move> movesOf(Ring ring) const;
    int64_t changeBy(const Move& move);

    const TetraComplex& complex_;
    const Components& pieces_;
    std::span<const uint8_t> fixed_;
    std::span<uint32_t> piece_;
    std::vector<uint32_t> members_;                     ///< of all rings
    std::vector<std::pair<uint32_t, uint32_t>> rings_;  ///< first, count
    std::vector<std::vector<uint32_t>> ringsAt_;        ///< per tetrahedron
    std::minstd_rand random_;
};

}  // namespace sherd
