// SPDX-License-Identifier: MIT
// Property tests: how many cases to run, and seeded randomness that is the same everywhere.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <random>

namespace sherd::test {

/// `cases` in a normal run; a tenth under sanitizers (SHERD_PROPERTY_PERCENT=10), more with --long.
inline int propertyCases(int cases) {
    const char* percent = std::getenv("SHERD_PROPERTY_PERCENT");
    return percent == nullptr ? cases : std::max(1, cases * std::atoi(percent) / 100);
}

/// Uniform numbers from std::mt19937 alone: the standard's distributions differ between libraries.
class Random {
  public:
    explicit Random(uint32_t seed) : engine_(seed) {}
    uint32_t below(uint32_t n) { return n == 0 ? 0 : engine_() % n; }
    double unit() { return engine_() / 4294967296.0; }
    double in(double low, double high) { return low + (high - low) * unit(); }

  private:
    std::mt19937 engine_;
};

}  // namespace sherd::test
