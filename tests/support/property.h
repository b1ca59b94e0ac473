// SPDX-License-Identifier: MIT
// Property tests: how many cases to run, and seeded randomness that is the same everywhere.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <numeric>
#include <random>
#include <vector>

namespace sherd::test {

/// `cases` in a normal run; a tenth under sanitizers (SHERD_PROPERTY_PERCENT=10), more with --long.
inline int propertyCases(int cases) {
    const char* percent = std::getenv("SHERD_PROPERTY_PERCENT");
    return percent == nullptr ? cases : std::max(1, cases * std::atoi(percent) / 100);
}

/// The seeds of a property test from `first` on, as many as `propertyCases(cases)`; with SHERD_SEED
/// set that one alone, so that a failing case can be run by itself.
inline std::vector<uint32_t> propertySeeds(uint32_t first, int cases) {
    if (const char* seed = std::getenv("SHERD_SEED"))
        return {static_cast<uint32_t>(std::strtoul(seed, nullptr, 10))};
    std::vector<uint32_t> seeds(static_cast<size_t>(propertyCases(cases)));
    std::iota(seeds.begin(), seeds.end(), first);
    return seeds;
}

/// Uniform numbers from std::mt19937 alone: the standard's distributions differ between libraries.
class Random {
  public:
    explicit Random(uint32_t seed) : engine_(seed) {}
    uint32_t below(uint32_t n) { return n == 0 ? 0 : engine_() % n; }
    double unit() { return engine_() / 4294967296.0; }
    double in(double low, double high) { return low + (high - low) * unit(); }
    bool oneIn(uint32_t n) { return below(n) == 0; }

  private:
    std::mt19937 engine_;
};

}  // namespace sherd::test
