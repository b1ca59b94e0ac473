// SPDX-License-Identifier: MIT
// Seeded randomness in space: the same on every machine.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

namespace sherd::samples {

/// A well-mixed hash of the four numbers.
uint32_t hash(int32_t x, int32_t y, int32_t z, uint32_t seed);

/// The hash as a number in [0, 1).
double hash01(int32_t x, int32_t y, int32_t z, uint32_t seed);

/// Gradient noise in about [-1, 1], lattice spacing 1 (K. Perlin, "Improving Noise", 2002).
double gradientNoise(const glm::dvec3& p, uint32_t seed);

/// Octaves of gradient noise, each twice as fine and half as strong; about [-1, 1].
double fractalNoise(const glm::dvec3& p, uint32_t octaves, uint32_t seed);

/// Three independent fractal noises as a vector.
glm::dvec3 fractalNoise3(const glm::dvec3& p, uint32_t octaves, uint32_t seed);

}  // namespace sherd::samples
