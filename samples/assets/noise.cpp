// SPDX-License-Identifier: MIT
#include "noise.h"

#include <array>
#include <cmath>
#include <glm/common.hpp>

namespace sherd::samples {
namespace {

uint32_t mix(uint32_t h) {
    h ^= h >> 16U;
    h *= 0x7feb352dU;
    h ^= h >> 15U;
    h *= 0x846ca68bU;
    return h ^ (h >> 16U);
}

/// Dot product with one of the twelve directions to a cube's edge midpoints.
double slope(uint32_t h, double x, double y, double z) {
    const std::array<std::array<double, 2>, 3> pairs{{{x, y}, {x, z}, {y, z}}};
    const auto& pair = pairs[(h >> 2U) % 3];
    return ((h & 1U) != 0 ? pair[0] : -pair[0]) + ((h & 2U) != 0 ? pair[1] : -pair[1]);
}

double fade(double t) {
    return t * t * t * (t * (t * 6 - 15) + 10);
}

}  // namespace

uint32_t hash(int32_t x, int32_t y, int32_t z, uint32_t seed) {
    uint32_t h = mix(seed + 0x9e3779b9U);
    h = mix(h ^ static_cast<uint32_t>(x));
    h = mix(h ^ static_cast<uint32_t>(y));
    return mix(h ^ static_cast<uint32_t>(z));
}

double hash01(int32_t x, int32_t y, int32_t z, uint32_t seed) {
    return hash(x, y, z, seed) / 4294967296.0;
}

double gradientNoise(const glm::dvec3& p, uint32_t seed) {
    const glm::dvec3 cell = glm::floor(p);
    const glm::dvec3 f = p - cell;
    const auto x = static_cast<int32_t>(cell.x);
    const auto y = static_cast<int32_t>(cell.y);
    const auto z = static_cast<int32_t>(cell.z);
    std::array<double, 8> values{};
    for (uint32_t c = 0; c < 8; ++c) {
        const int32_t dx = static_cast<int32_t>(c & 1U);
        const int32_t dy = static_cast<int32_t>((c >> 1U) & 1U);
        const int32_t dz = static_cast<int32_t>(c >> 2U);
        values[c] = slope(hash(x + dx, y + dy, z + dz, seed), f.x - dx, f.y - dy, f.z - dz);
    }
    const double u = fade(f.x);
    const double v = fade(f.y);
    const double low =
        glm::mix(glm::mix(values[0], values[1], u), glm::mix(values[2], values[3], u), v);
    const double high =
        glm::mix(glm::mix(values[4], values[5], u), glm::mix(values[6], values[7], u), v);
    return glm::mix(low, high, fade(f.z));
}

double fractalNoise(const glm::dvec3& p, uint32_t octaves, uint32_t seed) {
    double sum = 0;
    double weight = 0.5;
    double frequency = 1;
    for (uint32_t octave = 0; octave < octaves; ++octave) {
        sum += weight * gradientNoise(p * frequency, seed + octave);
        weight *= 0.5;
        frequency *= 2.03;
    }
    return sum;
}

glm::dvec3 fractalNoise3(const glm::dvec3& p, uint32_t octaves, uint32_t seed) {
    return {fractalNoise(p, octaves, seed), fractalNoise(p, octaves, seed + 101),
            fractalNoise(p, octaves, seed + 202)};
}

}  // namespace sherd::samples
