// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "sherd/formats/fracture_set.h"

namespace sherd::test {

inline bool same(const Range& a, const Range& b) {
    return a.first == b.first && a.count == b.count;
}

template <class T, class Same>
bool sameLists(const std::vector<T>& a, const std::vector<T>& b, Same equal) {
    if (a.size() != b.size()) return false;
    for (size_t i = 0; i < a.size(); ++i)
        if (!equal(a[i], b[i])) return false;
    return true;
}

inline bool same(const Fragment& a, const Fragment& b) {
    return a.parent == b.parent && same(a.children, b.children) && a.level == b.level &&
           a.name == b.name && a.material == b.material && a.mass == b.mass &&
           a.volume == b.volume && a.centerOfMass == b.centerOfMass &&
           a.inertiaDiagonal == b.inertiaDiagonal && a.inertiaOrientation == b.inertiaOrientation &&
           same(a.hulls, b.hulls) && a.density == b.density && a.friction == b.friction &&
           a.restitution == b.restitution && a.strength == b.strength && a.toughness == b.toughness;
}

inline bool same(const Bond& a, const Bond& b) {
    return a.a == b.a && a.b == b.b && a.area == b.area && a.centroid == b.centroid &&
           a.normal == b.normal && a.strength == b.strength && a.toughness == b.toughness;
}

/// The first member in which two sets differ, or "" when they are equal. Attributes in any order.
inline std::string whatDiffers(const FractureSet& a, const FractureSet& b) {
    if (a.name != b.name) return "name";
    if (a.node != b.node) return "node";
    if (a.sameNodes != b.sameNodes) return "sameNodes";
    if (a.joinedNodes != b.joinedNodes) return "joinedNodes";
    if (a.mesh != b.mesh) return "mesh";
    if (a.sourceHash != b.sourceHash) return "sourceHash";
    if (a.restPose.translation != b.restPose.translation) return "restPose.translation";
    if (a.restPose.rotation != b.restPose.rotation) return "restPose.rotation";
    if (a.materials != b.materials) return "materials";
    if (!sameLists(a.levels, b.levels, [](const FractureLevel& x, const FractureLevel& y) {
            return same(x.fragments, y.fragments) && x.name == y.name;
        }))
        return "levels";
    if (!sameLists(a.fragments, b.fragments,
                   [](const Fragment& x, const Fragment& y) { return same(x, y); }))
        return "fragments";
    if (!sameLists(a.fragmentRanges, b.fragmentRanges,
                   [](const Range& x, const Range& y) { return same(x, y); }))
        return "fragmentRanges";
    if (!sameLists(a.hulls, b.hulls, [](const ConvexHull& x, const ConvexHull& y) {
            return same(x.points, y.points) && x.margin == y.margin;
        }))
        return "hulls";
    if (a.hullPoints != b.hullPoints) return "hullPoints";
    if (!sameLists(a.bonds, b.bonds, [](const Bond& x, const Bond& y) { return same(x, y); }))
        return "bonds";
    if (a.geometry.positions != b.geometry.positions) return "positions";
    if (a.geometry.indices != b.geometry.indices) return "indices";
    if (!sameLists(a.geometry.primitives, b.geometry.primitives,
                   [](const Primitive& x, const Primitive& y) {
                       return x.material == y.material && x.exposedFrom == y.exposedFrom &&
                              x.sheet == y.sheet && same(x.indices, y.indices);
                   }))
        return "primitives";
    if (a.geometry.attributes.size() != b.geometry.attributes.size()) return "attributes";
    for (const Attribute& x : a.geometry.attributes) {
        bool found = false;
        for (const Attribute& y : b.geometry.attributes)
            found = found || (x.semantic == y.semantic && x.components == y.components &&
                              x.values == y.values);
        if (!found) return "attribute " + x.semantic;
    }
    return "";
}

}  // namespace sherd::test
