// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace sherd {

/// How many directions a set of points spans. Points within 1e-5 of a line or plane lie in it.
struct Span {
    int dimension = 0;
    glm::dvec3 direction{0.0};      ///< unit, for dimension 1: of the line; 2: normal of the plane
    std::vector<uint32_t> simplex;  ///< dimension + 1 points that span it
};

/// `points` are of about unit size.
Span spanOf(std::span<const glm::dvec3> points);

/// At most `count` of the points whose hull fills as much of the hull of all as greed can get.
std::vector<uint32_t> selectHullVertices(std::span<const glm::dvec3> points, const Span& span,
                                         uint32_t count);

}  // namespace sherd
