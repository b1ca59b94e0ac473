// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <span>
#include <vector>

namespace sherd {

struct SmoothingOptions {
    int iterations = 10;
    double lambda = 1;  ///< share of the way to the neighbours' mean, 0..1
    double mu = 0;      ///< Taubin's second, negative step; 0: none
    double reach = std::numeric_limits<double>::infinity();  ///< a point stops after k steps, once
                                                             ///< sqrt(k) of its edges are longer
};

/// Moves each point towards the weighted mean of its neighbours in the triangulation, several
/// times. Points without triangles stay.
std::vector<glm::dvec3> smoothed(std::span<const glm::dvec3> points,
                                 std::span<const std::array<uint32_t, 3>> triangles,
                                 const SmoothingOptions& options);

}  // namespace sherd
