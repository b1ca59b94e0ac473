// SPDX-License-Identifier: MIT
#include "assembly/physics.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <span>

#include "geometry/bounds.h"
#include "parallel/parallel_for.h"
#include "physics/bonds.h"
#include "physics/mass_properties.h"

namespace sherd {
namespace {

std::vector<glm::vec3> usedPositions(const FractureSet& set, uint32_t fragment) {
    std::vector<uint32_t> used;
    for (const auto& t : fragmentTriangles(set, fragment))
        used.insert(used.end(), t.begin(), t.end());
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    std::vector<glm::vec3> points;
    points.reserve(used.size());
    for (const uint32_t v : used) points.push_back(set.geometry.positions[v]);
    return points;
}

/// The inertia of the box around the points, its mass spread evenly.
glm::dmat3 boxInertia(std::span<const glm::vec3> points, double volume) {
    Bounds box;
    for (const glm::vec3& p : points) box.add(glm::dvec3(p));
    const glm::dvec3 s = box.size() * box.size() * (volume / 12);
    glm::dmat3 inertia(0.0);
    inertia[0][0] = s.y + s.z;
    inertia[1][1] = s.x + s.z;
    inertia[2][2] = s.x + s.y;
    return inertia;
}

/// The density of leaves together; where all are alike it is theirs to the bit.
float meanDensity(const FractureSet& set, const Hierarchy& hierarchy, Range ranks, double mean) {
    float low = std::numeric_limits<float>::max();
    float high = 0;
    for (uint32_t r = ranks.first; r < ranks.first + ranks.count; ++r) {
        const float density = set.fragments[hierarchy.fragmentOfRank[r]].density;
        low = std::min(low, density);
        high = std::max(high, density);
    }
    return std::clamp(static_cast<float>(mean), low, high);
}

}  // namespace

void assembleFragments(const Hierarchy& hierarchy, const PhysicsSettings& settings,
                       FractureSet& set) {
    set.fragments.resize(hierarchy.leaves.size());
    for (size_t f = 0; f < set.fragments.size(); ++f) {
        Fragment& fragment = set.fragments[f];
        fragment.parent = hierarchy.parent[f];
        fragment.children = hierarchy.children[f];
        fragment.level = hierarchy.level[f];
        fragment.density = static_cast<float>(settings.density);
        fragment.friction = static_cast<float>(settings.friction);
        fragment.restitution = static_cast<float>(settings.restitution);
        fragment.strength = static_cast<float>(settings.strength);
        fragment.toughness = static_cast<float>(settings.toughness);
    }
    for (const Range level : hierarchy.levels) set.levels.push_back({level, ""});
}

uint32_t assembleMasses(const Hierarchy& hierarchy, unsigned threads, FractureSet& set) {
    const size_t leafCount = hierarchy.leafOrder.size();
    std::vector<MassProperties> leaves(leafCount);
    std::vector<uint8_t> boxed(leafCount, 0);
    parallelRuns(leafCount, 1, threads, [&](size_t rank, size_t) {
        const uint32_t fragment = hierarchy.fragmentOfRank[rank];
        leaves[rank] = massProperties(set.geometry.positions, fragmentTriangles(set, fragment));
        if (isPhysical(leaves[rank])) return;
        boxed[rank] = 1;
        leaves[rank].inertia = boxInertia(usedPositions(set, fragment), leaves[rank].volume);
    });
    // Weighed by their density from here on: what was a volume is a mass.
    std::vector<double> volumes(leafCount);
    for (size_t rank = 0; rank < leafCount; ++rank) {
        volumes[rank] = leaves[rank].volume;
        const double density = set.fragments[hierarchy.fragmentOfRank[rank]].density;
        leaves[rank].volume *= density;
        leaves[rank].inertia *= density;
    }
    for (size_t f = 0; f < set.fragments.size(); ++f) {
        const Range range = hierarchy.leaves[f];
        const MassProperties whole = combine(std::span(leaves).subspan(range.first, range.count));
        const double volume = std::accumulate(volumes.begin() + range.first,
                                              volumes.begin() + range.first + range.count, 0.0);
        const PrincipalAxes axes = principalAxes(whole.inertia);
        Fragment& fragment = set.fragments[f];
        fragment.volume = static_cast<float>(volume);
        fragment.mass = static_cast<float>(whole.volume);
        if (fragment.children.count > 0)
            fragment.density = meanDensity(set, hierarchy, range, whole.volume / volume);
        fragment.centerOfMass = whole.center;
        fragment.inertiaDiagonal = axes.diagonal;
        fragment.inertiaOrientation = axes.orientation;
    }
    return static_cast<uint32_t>(std::count(boxed.begin(), boxed.end(), 1));
}

void assembleBonds(const Hierarchy& hierarchy, const BondStrengths& strengths,
                   double sheetTolerance, unsigned threads, FractureSet& set) {
    std::vector<HiddenTriangle> hidden;
    std::vector<uint32_t> leafFragments = hierarchy.fragmentOfRank;
    std::sort(leafFragments.begin(), leafFragments.end());
    leafFragments.erase(std::unique(leafFragments.begin(), leafFragments.end()),
                        leafFragments.end());
    const size_t primitiveCount = set.geometry.primitives.size();
    for (const uint32_t f : leafFragments) {
        for (size_t p = 0; p < primitiveCount; ++p) {
            if (set.geometry.primitives[p].exposedFrom == 0) continue;
            const Range range = set.fragmentRanges[f * primitiveCount + p];
            for (uint32_t i = range.first; i < range.first + range.count; i += 3) {
                const uint32_t* corner = set.geometry.indices.data() + i;
                hidden.push_back({{corner[0], corner[1], corner[2]}, f});
            }
        }
    }
    for (const LeafBond& leafBond :
         findBonds(set.geometry.positions, hidden, {sheetTolerance, threads})) {
        Bond bond;
        bond.a = static_cast<int32_t>(leafBond.a);
        bond.b = static_cast<int32_t>(leafBond.b);
        bond.area = static_cast<float>(leafBond.area);
        bond.centroid = leafBond.centroid;
        bond.normal = leafBond.normal;
        strengths.apply(set, bond);
        if (bond.area > 0) set.bonds.push_back(bond);
    }
}

}  // namespace sherd
