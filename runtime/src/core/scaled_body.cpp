// SPDX-License-Identifier: MIT
#include "core/scaled_body.h"

namespace sherd {

// Strength (Pa) and toughness (J/m^2) belong to the substance and stay: what breaking consumes
// grows with the bonds' areas, as it does in things that are larger.
FractureSet scaledBody(const FractureSet& set, float scale, float density) {
    const double s = double(scale), d = double(density);
    FractureSet result;
    result.name = set.name;
    result.node = set.node;
    result.sameNodes = set.sameNodes;
    result.joinedNodes = set.joinedNodes;
    result.mesh = set.mesh;
    result.sourceHash = set.sourceHash;
    result.restPose = set.restPose;
    result.materials = set.materials;
    result.levels = set.levels;
    result.fragments = set.fragments;
    for (Fragment& fragment : result.fragments) {
        fragment.mass = float(double(fragment.mass) * (s * s * s) * d);
        fragment.volume = float(double(fragment.volume) * (s * s * s));
        fragment.centerOfMass *= scale;
        fragment.inertiaDiagonal = glm::dvec3(fragment.inertiaDiagonal) * (s * s * s * s * s * d);
        fragment.density *= density;
    }
    result.hulls = set.hulls;
    for (ConvexHull& hull : result.hulls) hull.margin *= scale;
    result.hullPoints = set.hullPoints;
    for (glm::vec3& point : result.hullPoints) point *= scale;
    result.bonds = set.bonds;
    for (Bond& bond : result.bonds) {
        bond.area = float(double(bond.area) * (s * s));
        bond.centroid *= scale;
    }
    return result;
}

}  // namespace sherd
