// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <span>
#include <vector>

#include "interior/vertex_rings.h"

namespace sherd {

struct SmoothingOptions {
    int iterations = 10;
    double lambda = 1;  ///< share of the way to the neighbours' mean, 0..1
    double mu = 0;      ///< Taubin's second, negative step; 0: none
    double reach = std::numeric_limits<double>::infinity();  ///< a point stops after k steps, once
                                                             ///< sqrt(k) of its edges are longer
};

/// Moves each point towards the mean of its neighbours, several times. Points without neighbours
/// stay.
std::vector<glm::dvec3> smoothed(std::span<const glm::dvec3> points, const VertexRings& rings,
                                 const SmoothingOptions& options, unsigned threads = 1);

}  // namespace sherd
