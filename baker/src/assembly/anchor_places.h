// SPDX-License-Identifier: MIT
// Which part of a triangle lies where an anchor holds.
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "sherd/baker/recipe.h"
#include "sherd/formats/fracture_set.h"

namespace sherd {

/// A part of a flat surface: area and place of it, and its direction as long as the area.
struct SurfacePart {
    double area = 0;  ///< m^2
    glm::dvec3 moment{0.0}, normal{0.0};

    void add(const SurfacePart& other);
};

/// The places an anchor holds: an intersection of half-spaces.
class AnchorPlace {
  public:
    /// A place of the scene (not a label's), as the object's frame has it. What lies within `slack`
    /// metres of a border lies on it, and what lies on it is held: an object that stands on the
    /// ground is held by an anchor below the ground's height, however it was rounded there.
    AnchorPlace(const RecipeAnchor& anchor, const RigidPose& restPose, double slack);

    using Polygon = std::vector<glm::dvec3>;  ///< convex and flat
    /// Adds the part inside to `inside`; returns the rest, convex each.
    void take(const Polygon& polygon, SurfacePart& inside, std::vector<Polygon>& rest) const;

  private:
    struct HalfSpace {
        glm::dvec3 normal;  ///< unit, outwards
        double offset;
    };
    std::vector<HalfSpace> borders_;
    double slack_;
};

SurfacePart partOf(std::span<const glm::dvec3> polygon);

}  // namespace sherd
