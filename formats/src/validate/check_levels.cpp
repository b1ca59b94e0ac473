// SPDX-License-Identifier: MIT
// Levels add up: the children of a fragment show what it shows, plus faces that cancel.
#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

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
std::vector<Face> facesWithoutOpposite(const FractureSet& set, const std::vector<uint32_t>& welded,
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
    std::vector<Face> lonely;
    for (size_t i = 0; i < faces.size();) {
        int32_t net = 0;
        size_t j = i;
        for (; j < faces.size() && faces[j].corners == faces[i].corners; ++j) net += faces[j].sign;
        if (net != 0) lonely.push_back({faces[i].corners, net});
        i = j;
    }
    return lonely;
}

/// Areas of faces, their directions and where they are: 1, x, y, z, xx, yy, zz, xy, yz, zx of the
/// place, integrated over the faces as vectors.
struct FaceMoments {
    std::array<glm::dvec3, 10> sums{};
    double area = 0;

    void add(const std::array<glm::dvec3, 3>& p, double times) {
        const glm::dvec3 normal = 0.5 * times * glm::cross(p[1] - p[0], p[2] - p[0]);
        area += glm::length(normal);
        // The middles of its sides are as good as the whole triangle for polynomials of degree 2.
        for (size_t k = 0; k < 3; ++k) {
            const glm::dvec3 m = 0.5 * (p[k] + p[(k + 1) % 3]);
            const std::array<double, 10> f = {
                1, m.x, m.y, m.z, m.x * m.x, m.y * m.y, m.z * m.z, m.x * m.y, m.y * m.z, m.z * m.x};
            for (size_t i = 0; i < f.size(); ++i) sums[i] += normal * (f[i] / 3);
        }
    }
};

/// Whether faces that are cut differently cover each other all the same: then whatever is
/// integrated over them cancels. In a cube of side 2 around them.
bool coverEachOther(const FractureSet& set, const std::vector<Face>& faces) {
    glm::dvec3 low(std::numeric_limits<double>::max()), high(-low);
    for (const Face& face : faces) {
        for (const uint32_t v : face.corners) {
            low = glm::min(low, glm::dvec3(set.geometry.positions[v]));
            high = glm::max(high, glm::dvec3(set.geometry.positions[v]));
        }
    }
    const glm::dvec3 half = 0.5 * (high - low);
    const double scale = std::max({half.x, half.y, half.z});
    if (!(scale > 0)) return true;
    FaceMoments moments;
    for (const Face& face : faces) {
        std::array<glm::dvec3, 3> p;
        for (size_t k = 0; k < 3; ++k)
            p[k] = (glm::dvec3(set.geometry.positions[face.corners[k]]) - low - half) / scale;
        moments.add(p, face.sign);
    }
    // Rounded corners of n small faces are off by some 2^-24 of the object each.
    const double allowed = 1e-5 * moments.area + 1e-6;
    return std::all_of(moments.sums.begin(), moments.sums.end(),
                       [&](const glm::dvec3& sum) { return glm::length(sum) <= allowed; });
}

/// How many faces that dividing the parent exposes are not covered from the other side. Children
/// that are divided further may each be cut in their own way.
size_t facesUncovered(const FractureSet& set, const std::vector<uint32_t>& welded,
                      uint32_t parent) {
    const std::vector<Face> lonely = facesWithoutOpposite(set, welded, parent);
    const Range children = set.fragments[parent].children;
    bool further = false;
    for (uint32_t c = children.first; c < children.first + children.count; ++c)
        further = further || set.fragments[c].children.count > 0;
    return further && coverEachOther(set, lonely) ? 0 : lonely.size();
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
    if (const size_t lonely = facesUncovered(set, context.welded, f); lonely > 0)
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
           facesUncovered(set, weldEqualPositions(set.geometry.positions), parent) == 0;
}

}  // namespace sherd
