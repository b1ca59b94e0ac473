// SPDX-License-Identifier: MIT
// Convex polyhedra of colliders: hulls of points, volumes and cuts by planes.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace sherd {

/// n . x <= offset, n unit.
struct HalfSpace {
    glm::dvec3 normal;
    double offset;
};

struct Polytope {
    std::vector<glm::dvec3> points;              ///< all of them corners of faces
    std::vector<std::array<uint32_t, 3>> faces;  ///< counter-clockwise from outside; coplanar ones
                                                 ///< may lie side by side
    std::vector<uint32_t> sources;               ///< per point: which of the input it is

    bool empty() const { return faces.empty(); }
};

/// A tenth of what floats hold of an extent.
inline constexpr double kRoundingSkin = 1e-8;

/// The convex hull of points whose coordinates are 0 or within 1e-70 to 1e70, but for some that lie
/// outside of it by about `skin` of their diagonal at most. Closed and convex to the last bit
/// whatever comes in. Empty if all points lie in one plane.
Polytope hullOf(std::span<const glm::dvec3> points, double skin = kRoundingSkin);

double volumeOf(const Polytope& polytope);

/// Of all that is within `margin` of it.
double roundedVolume(const Polytope& polytope, double margin);

/// Of the part where the half-space does not hold.
double volumeBeyond(const Polytope& polytope, const HalfSpace& wall);

/// Where a -> b meets a wall, from their heights of different signs. The same point from b to a.
glm::dvec3 wallCrossing(glm::dvec3 a, double ha, glm::dvec3 b, double hb);

/// The part where the half-space holds, but for rounding; empty if that has no volume. Its sources
/// mean nothing.
Polytope clipped(const Polytope& polytope, const HalfSpace& wall);

/// Those through its faces, those of coplanar ones (within rounding) once.
std::vector<HalfSpace> halfSpacesOf(const Polytope& polytope);

/// How far the points reach along a direction: lowest and highest.
struct Reach {
    double low, high;
};
Reach reachOf(std::span<const glm::dvec3> points, const glm::dvec3& direction);

}  // namespace sherd
