// SPDX-License-Identifier: MIT
// Bonds against the walls that the leaves' meshes share. Sheets that face each other share no
// corners; how much of them a bond may count is bounded by what no wall explains.
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>
#include <utility>

#include "check_context.h"

namespace sherd {

namespace {

using LeafPair = std::pair<int32_t, int32_t>;  ///< ascending

struct HiddenFace {
    Face face;
    uint32_t leaf = 0;
    double area = 0;
};

struct Shared {
    double area = 0;
    double unsure = 0;        ///< m^2 of faces that more than two leaves use
    glm::dvec3 moment{0};     ///< centroid times area
    glm::dvec3 direction{0};  ///< area vector, out of the leaf of lower index
};

struct Walls {
    std::map<LeafPair, Shared> shared;
    std::vector<double> loose;    ///< m^2 per fragment: hidden, in no wall
    std::vector<double> surface;  ///< m^2 per fragment, hidden and outer
    double area = 0;
};

glm::dvec3 areaVector(const FractureSet& set, const std::array<uint32_t, 3>& t) {
    const std::vector<glm::vec3>& p = set.geometry.positions;
    const glm::dvec3 a(p[t[0]]);
    return 0.5 * glm::cross(glm::dvec3(p[t[1]]) - a, glm::dvec3(p[t[2]]) - a);
}

std::vector<HiddenFace> hiddenFaces(const CheckContext& context, Walls& walls) {
    const FractureSet& set = context.set;
    std::vector<HiddenFace> faces;
    for (uint32_t f = 0; f < set.fragments.size(); ++f) {
        if (set.fragments[f].children.count > 0) continue;
        forEachTriangle(set, f, [&](size_t p, uint32_t a, uint32_t b, uint32_t c) {
            const double area = glm::length(areaVector(set, {a, b, c}));
            walls.surface[f] += area;
            if (set.geometry.primitives[p].exposedFrom == 0) return;
            walls.loose[f] += area;
            const auto& welded = context.welded;
            faces.push_back({sortedFace({welded[a], welded[b], welded[c]}), f, area});
        });
    }
    std::sort(faces.begin(), faces.end(), [](const HiddenFace& x, const HiddenFace& y) {
        return x.face.corners < y.face.corners;
    });
    return faces;
}

void share(const FractureSet& set, const HiddenFace& x, const HiddenFace& y, bool sure,
           Walls& walls) {
    if (x.leaf == y.leaf || x.face.sign == y.face.sign) return;
    const HiddenFace& low = x.leaf < y.leaf ? x : y;
    const HiddenFace& high = x.leaf < y.leaf ? y : x;
    Shared& shared = walls.shared[{low.leaf, high.leaf}];
    if (!sure) {
        shared.unsure += x.area;
        return;
    }
    const std::array<uint32_t, 3>& corners = x.face.corners;
    const std::vector<glm::vec3>& p = set.geometry.positions;
    shared.area += x.area;
    shared.moment +=
        x.area / 3 *
        (glm::dvec3(p[corners[0]]) + glm::dvec3(p[corners[1]]) + glm::dvec3(p[corners[2]]));
    shared.direction += double(low.face.sign) * areaVector(set, corners);
    walls.loose[x.leaf] -= x.area;
    walls.loose[y.leaf] -= x.area;
    walls.area += x.area;
}

Walls findWalls(const CheckContext& context) {
    Walls walls;
    walls.loose.resize(context.set.fragments.size());
    walls.surface.resize(context.set.fragments.size());
    const std::vector<HiddenFace> faces = hiddenFaces(context, walls);
    for (size_t i = 0; i < faces.size();) {
        size_t end = i + 1;
        while (end < faces.size() && faces[end].face.corners == faces[i].face.corners) ++end;
        for (size_t x = i; x < end; ++x)
            for (size_t y = x + 1; y < std::min(end, x + 8); ++y)
                share(context.set, faces[x], faces[y], end - i == 2, walls);
        i = end;
    }
    return walls;
}

/// The bonds of one pair of leaves, as a rule a single one.
struct Held {
    size_t bond = 0;  ///< the first
    double area = 0;
    glm::dvec3 moment{0};
    glm::dvec3 normal{0};  ///< times area, out of the leaf of lower index
};

void checkArea(const CheckContext& context, const Held& held, double least, double most) {
    if (held.area >= 0.99 * least && held.area <= 1.01 * most) return;
    context.find(Severity::failure, "bond_area", context.set.bonds[held.bond].a,
                 "bond " + std::to_string(held.bond) + " says " + shortNumber(held.area) +
                     " m^2, its leaves share " + shortNumber(least) +
                     (most > least ? " to " + shortNumber(most) : std::string()),
                 "/bonds/attributes/AREA");
}

void checkPair(const CheckContext& context, const Walls& walls, const LeafPair& pair,
               const Held& held) {
    const auto found = walls.shared.find(pair);
    const Shared shared = found == walls.shared.end() ? Shared() : found->second;
    const auto a = static_cast<size_t>(pair.first);
    const auto b = static_cast<size_t>(pair.second);
    const double loose = std::max(0.0, 0.5 * (walls.loose[a] + walls.loose[b]));
    const double most = shared.area + shared.unsure + loose;
    checkArea(context, held, shared.area, most);
    if (!(held.area > 0) || most > 1.001 * shared.area) return;
    // Nothing but walls: the place and the direction of the bond are known.
    const glm::dvec3 place = shared.moment / shared.area;
    const double off = glm::distance(place, held.moment / held.area);
    if (off > 1e-3 * context.out.diagonal + 1e-6 * glm::length(place))
        context.find(Severity::failure, "bond_centroid", context.set.bonds[held.bond].a,
                     "bond " + std::to_string(held.bond) + " lies " + shortNumber(off) +
                         " m from the middle of the area it stands for",
                     "/bonds/attributes/CENTROID");
    const double length = glm::length(shared.direction) * glm::length(held.normal);
    // A wall that closes on itself has no direction.
    if (glm::length(shared.direction) > 0.01 * shared.area &&
        glm::dot(shared.direction, held.normal) < 0.99 * length)
        context.find(Severity::failure, "bond_normal", context.set.bonds[held.bond].a,
                     "the normal of bond " + std::to_string(held.bond) +
                         " is not that of the area it stands for",
                     "/bonds/attributes/NORMAL");
}

void checkPlace(const CheckContext& context, size_t b) {
    const Bond& bond = context.set.bonds[b];
    const MeshMeasures& one = context.measures[static_cast<size_t>(bond.a)];
    const MeshMeasures& two = context.measures[static_cast<size_t>(std::max(bond.b, 0))];
    const glm::dvec3 low = bond.b < 0 ? one.low : glm::max(one.low, two.low);
    const glm::dvec3 high = bond.b < 0 ? one.high : glm::min(one.high, two.high);
    const glm::dvec3 p(bond.centroid);
    const glm::dvec3 out = glm::max(glm::max(low - p, p - high), glm::dvec3(0));
    const double off = std::max({out.x, out.y, out.z});
    if (off > 2e-3 * context.out.diagonal + 1e-6 * glm::length(p))
        context.find(Severity::failure, "bond_centroid", bond.a,
                     "bond " + std::to_string(b) + " lies " + shortNumber(off) +
                         " m out of the box where its leaves can meet",
                     "/bonds/attributes/CENTROID");
}

void checkMissing(const CheckContext& context, const Walls& walls,
                  const std::map<LeafPair, Held>& held) {
    double total = 0;
    for (const auto& [pair, one] : held) total += one.area;
    if (walls.area > 0 && !(total > 0))
        return context.find(Severity::failure, "no_bonds", -1,
                            "leaves share " + shortNumber(walls.area) +
                                " m^2 of walls, and nothing holds them together",
                            "/bonds");
    for (const auto& [pair, shared] : walls.shared)
        if (shared.area > 1e-6 * walls.area && held.count(pair) == 0)
            context.find(Severity::warning, "bond_missing", pair.first,
                         "no bond holds it to fragment " + std::to_string(pair.second) +
                             ", with which it shares " + shortNumber(shared.area) + " m^2",
                         "/bonds");
}

}  // namespace

void checkBonds(CheckContext& context) {
    const std::vector<Bond>& bonds = context.set.bonds;
    const Walls walls = findWalls(context);
    std::map<LeafPair, Held> held;
    for (size_t b = 0; b < bonds.size(); ++b) {
        const Bond& bond = bonds[b];
        const double area = bond.area;
        checkPlace(context, b);
        if (!(area > 0)) {
            context.find(Severity::failure, "bond_area", bond.a,
                         "bond " + std::to_string(b) + " has no area", "/bonds/attributes/AREA");
        }
        if (bond.b < 0) {
            checkArea(context, {b, area, {}, {}}, 0, walls.surface[static_cast<size_t>(bond.a)]);
            continue;
        }
        Held& pair =
            held.try_emplace(std::minmax(bond.a, bond.b), Held{b, 0, {}, {}}).first->second;
        pair.area += area;
        pair.moment += area * glm::dvec3(bond.centroid);
        pair.normal += (bond.a < bond.b ? area : -area) * glm::dvec3(bond.normal);
    }
    for (const auto& [pair, sum] : held)
        if (sum.area > 0) checkPair(context, walls, pair, sum);
    checkMissing(context, walls, held);
}

}  // namespace sherd
