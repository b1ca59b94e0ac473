// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <glm/vec3.hpp>

namespace sherd {

/// Whether the insides of two triangles, without their borders, share a point, decided exactly:
/// they cross each other, or lie in one plane and overlap. What touches in corners and edges only,
/// as neighbours in a mesh do, does not cross; a neighbour folded back onto its like does.
/// Triangles without area have no inside.
///
/// Holds one triangle, to be asked about many.
class CrossingTest {
  public:
    using Triangle = std::array<glm::dvec3, 3>;
    explicit CrossingTest(const Triangle& own);
    bool crosses(const Triangle& other) const;

  private:
    using Signs = std::array<int, 3>;
    /// Sides of a plane. The filter is that of orient3d, its bound computed once for all points
    /// (Shewchuk 1997: it holds whichever point is subtracted).
    struct Plane {
        explicit Plane(const Triangle& t);
        int side(const Triangle& t, const glm::dvec3& p) const;
        Signs sides(const Triangle& t, const Triangle& points) const;
        glm::dvec3 normal{0}, bound{0};
    };

    Triangle own_;
    Plane plane_;
};

}  // namespace sherd
