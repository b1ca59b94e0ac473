// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <vector>

namespace sherd {

/// A rational B-spline in the plane: Piegl and Tiller 1997, "The NURBS Book", chapters 2 to 4.
struct NurbsCurve {
    size_t degree = 3;  ///< 1 to kMaxNurbsDegree
    bool closed = false;
    std::vector<glm::dvec2> points;  ///< more than `degree`; a closed curve does not repeat them
    std::vector<double> weights;     ///< one a point, finite, above 0; none: all 1
    /// Non-decreasing. Open: points + degree + 1 of them, none: clamped and uniform. Closed:
    /// points + 1, one period from its first to its last; none: uniform.
    std::vector<double> knots;
};

inline constexpr size_t kMaxNurbsDegree = 10;

struct NurbsProblem {
    std::string member;  ///< "points", "weights" or "knots", or "knots/3"
    std::string message;
};

/// What is wrong with the curve, if anything.
std::optional<NurbsProblem> checkNurbs(const NurbsCurve& curve);

/// A line no further than `tolerance` from the curve, nor the curve from it. A clamped curve's ends
/// are its first and last point exactly; a closed one's first point is repeated. Nothing if it
/// would be more than `limit` points, or goes as far as -1000 or 1000. The curve must have passed
/// checkNurbs.
std::optional<std::vector<glm::dvec2>> flattenNurbs(const NurbsCurve& curve, double tolerance,
                                                    size_t limit);

}  // namespace sherd
