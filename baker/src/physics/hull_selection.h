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

/// How many points may be chosen, and what is worth more than that.
struct SelectionGoal {
    uint32_t count = 16;
    uint32_t most = 16;  ///< as many as this where the count does not meet what follows
    double volume = 0;   ///< to be filled, in the cube of the points' unit
    double reach = 0;    ///< how far points that count may stay outside
    std::span<const uint8_t> counts = {};  ///< per point whether it does; empty: none
};

/// The points whose hull fills as much of the hull of all as greed can get.
std::vector<uint32_t> selectHullVertices(std::span<const glm::dvec3> points, const Span& span,
                                         const SelectionGoal& goal);

}  // namespace sherd
