// SPDX-License-Identifier: MIT
#include "sherd/formats/fracture_rules.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace sherd {

namespace {

using MaybeError = std::optional<Error>;

MaybeError wrong(std::string message, std::string where) {
    return Error{ErrorCode::invalidData, std::move(message), std::move(where)};
}

bool inside(const Range& inner, uint64_t size) {
    return uint64_t{inner.first} + inner.count <= size;
}

bool inside(const Range& inner, const Range& outer) {
    return inner.count == 0 ||
           (inner.first >= outer.first &&
            uint64_t{inner.first} + inner.count <= uint64_t{outer.first} + outer.count);
}

bool isUnit(float squared) {
    return std::abs(squared - 1.0F) < 1e-3F;
}

float squaredLength(const glm::quat& q) {
    return q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w;
}
float squaredLength(const glm::vec3& v) {
    return v.x * v.x + v.y * v.y + v.z * v.z;
}

bool isFinite(float x) {
    return std::isfinite(x);
}
bool isFinite(const glm::vec3& v) {
    return isFinite(v.x) && isFinite(v.y) && isFinite(v.z);
}
template <class Numbers>
bool areFinite(const Numbers& numbers) {
    return std::all_of(numbers.begin(), numbers.end(), [](const auto& x) { return isFinite(x); });
}

/// What a file cannot get wrong, but a set made in memory can.
MaybeError checkSizes(const FractureSet& set, const std::string& where) {
    const FractureGeometry& g = set.geometry;
    if (set.fragments.empty()) return wrong("there are no fragments", where + "/fragments");
    if (set.fragmentRanges.size() != set.fragments.size() * g.primitives.size())
        return wrong("there must be one range for every fragment and primitive",
                     where + "/fragments/attributes/RANGES");
    for (const Attribute& attribute : g.attributes)
        if (attribute.components < 1 || attribute.components > 4 ||
            attribute.values.size() != g.positions.size() * attribute.components)
            return wrong("every vertex must have its 1 to 4 components",
                         where + "/geometry/attributes/" + attribute.semantic);
    return {};
}

MaybeError checkFinite(const FractureSet& set, const std::string& where) {
    const auto refuse = [&](const char* place) {
        return wrong("there are numbers that are not finite", where + place);
    };
    const glm::quat& turn = set.restPose.rotation;
    if (!isFinite(set.restPose.translation) || !isFinite(glm::vec3(turn.x, turn.y, turn.z)) ||
        !isFinite(turn.w))
        return refuse("/restPose");
    if (!areFinite(set.geometry.positions)) return refuse("/geometry/attributes/POSITION");
    for (const Attribute& attribute : set.geometry.attributes)
        if (!areFinite(attribute.values))
            return wrong("there are numbers that are not finite",
                         where + "/geometry/attributes/" + attribute.semantic);
    if (!areFinite(set.hullPoints)) return refuse("/hulls/points");
    for (const ConvexHull& hull : set.hulls)
        if (!isFinite(hull.margin)) return refuse("/hulls/attributes/MARGIN");
    for (size_t i = 0; i < set.fragments.size(); ++i) {
        const Fragment& f = set.fragments[i];
        const auto of = [&](const char* attribute) {
            return wrong("fragment " + std::to_string(i) + ": this must be finite",
                         where + "/fragments/attributes/" + attribute);
        };
        if (!isFinite(f.mass)) return of("MASS");
        if (!isFinite(f.volume)) return of("VOLUME");
        if (!isFinite(f.centerOfMass)) return of("CENTER_OF_MASS");
        if (!isFinite(f.inertiaDiagonal)) return of("INERTIA_DIAGONAL");
        if (!isFinite(f.density)) return of("DENSITY");
        if (!isFinite(f.friction)) return of("FRICTION");
        if (!isFinite(f.restitution)) return of("RESTITUTION");
        if (!isFinite(f.strength)) return of("STRENGTH");
        if (!isFinite(f.toughness)) return of("TOUGHNESS");
    }
    for (size_t b = 0; b < set.bonds.size(); ++b) {
        const Bond& bond = set.bonds[b];
        if (!isFinite(bond.centroid) || !isFinite(bond.normal) ||
            !areFinite(std::array{bond.area, bond.strength, bond.toughness}))
            return wrong("bond " + std::to_string(b) + ": its numbers must be finite",
                         where + "/bonds/attributes");
    }
    return {};
}

MaybeError checkLevels(const FractureSet& set, const std::string& where) {
    uint64_t next = 0;
    for (size_t k = 0; k < set.levels.size(); ++k) {
        const Range range = set.levels[k].fragments;
        const std::string at = where + "/levels/" + std::to_string(k);
        if (range.first != next || range.count == 0 || !inside(range, set.fragments.size()) ||
            (k == 0 && range.count != 1))
            return wrong("levels must follow each other, level 0 holding the object alone", at);
        next += range.count;
    }
    if (next != set.fragments.size())
        return wrong("every fragment must belong to one level", where + "/levels");
    for (size_t k = 0; k < set.levels.size(); ++k) {
        const Range range = set.levels[k].fragments;
        for (uint32_t f = range.first; f < range.first + range.count; ++f)
            if (set.fragments[f].level != k)
                return wrong("fragment " + std::to_string(f) + " is of another level",
                             where + "/levels/" + std::to_string(k));
    }
    return {};
}

MaybeError checkParents(const FractureSet& set, const std::string& at) {
    for (size_t f = 0; f < set.fragments.size(); ++f) {
        const Fragment& fragment = set.fragments[f];
        const std::string who = "fragment " + std::to_string(f);
        if (f == 0 ? fragment.parent != -1 : fragment.parent < 0)
            return wrong(who + ": fragment 0, and no other, has no parent", at);
        if (f > 0 && (static_cast<size_t>(fragment.parent) >= f ||
                      set.fragments[fragment.parent].level >= fragment.level))
            return wrong(who + ": a parent must come before its children, at a shallower level",
                         at);
    }
    return {};
}

MaybeError checkChildren(const FractureSet& set, const std::string& at) {
    uint64_t childrenNamed = 0;
    for (size_t f = 0; f < set.fragments.size(); ++f) {
        const Range children = set.fragments[f].children;
        const std::string who = "fragment " + std::to_string(f);
        if (!inside(children, set.fragments.size()))
            return wrong(who + ": children out of range", at);
        for (uint32_t c = 0; c < children.count; ++c) {
            const Fragment& child = set.fragments[children.first + c];
            if (child.parent != static_cast<int32_t>(f) ||
                child.level != set.fragments[children.first].level)
                return wrong(who + ": children must name it as their parent and share a level", at);
        }
        childrenNamed += children.count;
    }
    if (childrenNamed + 1 != set.fragments.size())
        return wrong("some fragment is missing among its parent's children", at);
    return {};
}

MaybeError checkGeometry(const FractureSet& set, const std::string& where) {
    const FractureGeometry& g = set.geometry;
    const std::string at = where + "/geometry";
    if (g.positions.size() > static_cast<size_t>(std::numeric_limits<int32_t>::max()))
        return wrong("too many vertices", at + "/vertexCount");
    uint32_t highest = 0;
    for (const uint32_t index : g.indices) highest = std::max(highest, index);
    if (highest >= g.positions.size())
        return wrong("index " + std::to_string(highest) + " names no vertex", at + "/indices");
    for (size_t p = 0; p < g.primitives.size(); ++p) {
        const Primitive& primitive = g.primitives[p];
        const std::string here = at + "/primitives/" + std::to_string(p);
        if (primitive.material >= set.materials.size())
            return wrong("there is no such entry in materials", here + "/material");
        if (primitive.exposedFrom >= set.levels.size())
            return wrong("there is no such level", here + "/exposedFrom");
        if (!inside(primitive.indices, g.indices.size()) || primitive.indices.first % 3 != 0 ||
            primitive.indices.count % 3 != 0)
            return wrong("indices must be whole triangles within indexCount", here + "/indices");
    }
    return {};
}

MaybeError checkRanges(const FractureSet& set, const std::string& where) {
    const std::vector<Primitive>& primitives = set.geometry.primitives;
    for (size_t f = 0; f < set.fragments.size(); ++f) {
        for (size_t p = 0; p < primitives.size(); ++p) {
            const Range& range = set.fragmentRanges[f * primitives.size() + p];
            if (!inside(range, primitives[p].indices) || range.count % 3 != 0 ||
                (range.count > 0 && range.first % 3 != 0) ||
                !inside(range, set.geometry.indices.size()))
                return wrong("fragment " + std::to_string(f) + ": its range of primitive " +
                                 std::to_string(p) + " must be whole triangles of that primitive",
                             where + "/fragments/attributes/RANGES");
        }
    }
    return {};
}

MaybeError checkQuantities(const FractureSet& set, const std::string& where) {
    const std::string at = where + "/fragments/attributes/";
    for (size_t f = 0; f < set.fragments.size(); ++f) {
        const Fragment& x = set.fragments[f];
        const std::string who = "fragment " + std::to_string(f) + ": ";
        if (!(x.mass > 0)) return wrong(who + "the mass must be above 0", at + "MASS");
        if (!(x.volume > 0)) return wrong(who + "the volume must be above 0", at + "VOLUME");
        if (!(x.density > 0)) return wrong(who + "the density must be above 0", at + "DENSITY");
        if (!(x.inertiaDiagonal.x >= 0 && x.inertiaDiagonal.y >= 0 && x.inertiaDiagonal.z >= 0))
            return wrong(who + "inertia must not be negative", at + "INERTIA_DIAGONAL");
        if (!isUnit(squaredLength(x.inertiaOrientation)))
            return wrong(who + "this must be a unit quaternion", at + "INERTIA_ORIENTATION");
        if (!(x.friction >= 0)) return wrong(who + "this must not be negative", at + "FRICTION");
        if (!(x.restitution >= 0))
            return wrong(who + "this must not be negative", at + "RESTITUTION");
        if (!(x.strength >= 0)) return wrong(who + "this must not be negative", at + "STRENGTH");
        if (!(x.toughness >= 0)) return wrong(who + "this must not be negative", at + "TOUGHNESS");
        if (!inside(x.hulls, set.hulls.size()))
            return wrong(who + "there are no such hulls", at + "HULLS");
    }
    return {};
}

MaybeError checkHulls(const FractureSet& set, const std::string& where) {
    for (size_t h = 0; h < set.hulls.size(); ++h) {
        const std::string who = "hull " + std::to_string(h) + ": ";
        if (!inside(set.hulls[h].points, set.hullPoints.size()) || set.hulls[h].points.count == 0)
            return wrong(who + "its points are out of range", where + "/hulls/attributes/POINTS");
        if (!(set.hulls[h].margin >= 0))
            return wrong(who + "the margin must not be negative",
                         where + "/hulls/attributes/MARGIN");
    }
    return {};
}

MaybeError checkBonds(const FractureSet& set, const std::string& where) {
    const auto isLeaf = [&](int32_t f) {
        return f >= 0 && static_cast<size_t>(f) < set.fragments.size() &&
               set.fragments[f].children.count == 0;
    };
    const std::string at = where + "/bonds/attributes/";
    for (size_t b = 0; b < set.bonds.size(); ++b) {
        const Bond& bond = set.bonds[b];
        const std::string who = "bond " + std::to_string(b) + ": ";
        if (!isLeaf(bond.a) || (bond.b != -1 && !isLeaf(bond.b)) || bond.a == bond.b)
            return wrong(who + "it must join two fragments that are not divided further",
                         at + "FRAGMENTS");
        if (!(bond.area >= 0)) return wrong(who + "the area must not be negative", at + "AREA");
        if (!isUnit(squaredLength(bond.normal)))
            return wrong(who + "this must be a unit vector", at + "NORMAL");
        if (!(bond.strength >= 0)) return wrong(who + "this must not be negative", at + "STRENGTH");
        if (!(bond.toughness >= 0))
            return wrong(who + "this must not be negative", at + "TOUGHNESS");
    }
    return {};
}

}  // namespace

void numberLevels(FractureSet& set) {
    for (size_t k = 0; k < set.levels.size(); ++k) {
        const Range range = set.levels[k].fragments;
        if (!inside(range, set.fragments.size())) return;
        for (uint32_t f = range.first; f < range.first + range.count; ++f)
            set.fragments[f].level = static_cast<uint32_t>(k);
    }
}

std::optional<Error> brokenFractureRule(const FractureSet& set, const std::string& where) {
    if (auto error = checkSizes(set, where)) return error;
    if (auto error = checkFinite(set, where)) return error;
    if (!isUnit(squaredLength(set.restPose.rotation)))
        return wrong("this must be a unit quaternion", where + "/restPose/rotation");
    if (auto error = checkLevels(set, where)) return error;
    const std::string tables = where + "/fragments/attributes";
    if (auto error = checkParents(set, tables + "/PARENT")) return error;
    if (auto error = checkChildren(set, tables + "/CHILDREN")) return error;
    if (auto error = checkGeometry(set, where)) return error;
    if (auto error = checkRanges(set, where)) return error;
    if (auto error = checkQuantities(set, where)) return error;
    if (auto error = checkHulls(set, where)) return error;
    return checkBonds(set, where);
}

}  // namespace sherd
