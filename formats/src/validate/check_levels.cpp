// SPDX-License-Identifier: MIT
// Levels add up: the children of a fragment show what it shows, plus faces that cancel.
#include <algorithm>
#include <array>
#include <cmath>

#include "check_context.h"

namespace sherd {

namespace {

/// The primitive in which the children's ranges are not the parent's, or -1.
int32_t primitiveNotPassedOn(const FractureSet& set, uint32_t parent) {
    const std::vector<Primitive>& primitives = set.geometry.primitives;
    const Range children = set.fragments[parent].children;
    for (size_t p = 0; p < primitives.size(); ++p) {
        if (primitives[p].exposedFrom > set.fragments[parent].level) continue;
        const Range whole = set.fragmentRanges[parent * primitives.size() + p];
        uint64_t next = whole.first;
        for (uint32_t c = 0; c < children.count; ++c) {
            const Range part = set.fragmentRanges[(children.first + c) * primitives.size() + p];
            if (part.count == 0) continue;
            if (part.first != next) return static_cast<int32_t>(p);
            next += part.count;
        }
        if (next != uint64_t{whole.first} + whole.count) return static_cast<int32_t>(p);
    }
    return -1;
}

/// Faces that dividing the parent exposes and that have no opposite.
size_t facesWithoutOpposite(const FractureSet& set, const std::vector<uint32_t>& welded,
                            uint32_t parent) {
    std::vector<Face> faces;
    const Range children = set.fragments[parent].children;
    for (uint32_t c = children.first; c < children.first + children.count; ++c)
        forEachTriangle(set, c, [&](size_t p, uint32_t x, uint32_t y, uint32_t z) {
            if (set.geometry.primitives[p].exposedFrom <= set.fragments[parent].level) return;
            const std::array<uint32_t, 3> corners = {welded[x], welded[y], welded[z]};
            if (corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0])
                faces.push_back(sortedFace(corners));
        });
    std::sort(faces.begin(), faces.end(),
              [](const Face& a, const Face& b) { return a.corners < b.corners; });
    size_t lonely = 0;
    for (size_t i = 0; i < faces.size();) {
        int32_t net = 0;
        size_t j = i;
        for (; j < faces.size() && faces[j].corners == faces[i].corners; ++j) net += faces[j].sign;
        lonely += static_cast<size_t>(std::abs(net));
        i = j;
    }
    return lonely;
}

void checkParent(CheckContext& context, uint32_t f) {
    const FractureSet& set = context.set;
    const auto id = static_cast<int32_t>(f);
    if (const int32_t p = primitiveNotPassedOn(set, f); p >= 0)
        context.find(
            Severity::failure, "children_ranges", id,
            "its children's ranges of primitive " + std::to_string(p) + " do not make up its own",
            "/fragments/attributes/RANGES");
    if (f == 0) return;  // between the sheets of a medial interior the object has a core
    if (const size_t lonely = facesWithoutOpposite(set, context.welded, f); lonely > 0)
        context.find(Severity::failure, "inner_faces_unpaired", id,
                     std::to_string(lonely) +
                         " inner faces of its children have no opposite in another child",
                     "/geometry/primitives");
    double sum = 0;
    const Range children = set.fragments[f].children;
    for (uint32_t c = children.first; c < children.first + children.count; ++c)
        sum += context.measures[c].volume;
    const double own = context.measures[f].volume;
    if (std::abs(sum - own) > 1e-5 * std::abs(own))
        context.find(
            Severity::failure, "volume_sum", id,
            "its children enclose " + shortNumber(sum) + " m^3, it encloses " + shortNumber(own),
            "/geometry");
}

}  // namespace

void checkLevelsAddUp(CheckContext& context) {
    for (uint32_t f = 0; f < context.set.fragments.size(); ++f)
        if (context.set.fragments[f].children.count > 0) checkParent(context, f);
}

bool childrenAddUp(const FractureSet& set, uint32_t parent) {
    if (primitiveNotPassedOn(set, parent) >= 0) return false;
    return parent == 0 ||
           facesWithoutOpposite(set, weldEqualPositions(set.geometry.positions), parent) == 0;
}

}  // namespace sherd
