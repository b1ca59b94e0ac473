// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <random>

namespace sherd {

/// Random numbers that are the same with every standard library: the generators are defined to the
/// bit, the distributions are not.
class Dice {
  public:
    explicit Dice(uint64_t seed) : engine_(seed) {}
    double unit() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }            ///< 0..1
    double signedUnit() { return static_cast<double>(engine_() >> 11) * 0x1p-52 - 1; }  ///< -1..1

  private:
    std::mt19937_64 engine_;
};

}  // namespace sherd
