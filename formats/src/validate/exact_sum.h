// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>

namespace sherd {

/// A sum of products of three floats without any error: a fixed-point number wide enough for all of
/// them (U. Kulisch, "Computer Arithmetic and Validity", 2008: the long accumulator).
class ExactSum {
  public:
    /// Adds sign * a * b * c; the factors are finite.
    void add(int sign, float a, float b, float c);
    int sign() const;

  private:
    /// The smallest product is 2^-447, the largest below 2^384; 1024 bits leave room for 2^190.
    static constexpr int kLowest = -447;
    static constexpr int kWords = 32;
    void addAt(int bit, uint64_t value, bool negative);

    std::array<uint32_t, kWords> words_{};  ///< two's complement, lowest first
};

}  // namespace sherd
