// SPDX-License-Identifier: MIT
#include "assembly/labels.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <map>

#include "surface/surface_point.h"

namespace sherd {
namespace {

/// The fragment that holds the triangle at the label's level.
uint32_t fragmentOf(const PlacedLabel& placed, const Components& components,
                    const Hierarchy& hierarchy) {
    uint32_t fragment =
        hierarchy.fragmentOfRank[hierarchy.rankOfLeaf[components.leaf[placed.triangle]]];
    while (hierarchy.level[fragment] > placed.level)
        fragment = static_cast<uint32_t>(hierarchy.parent[fragment]);
    return fragment;
}

void apply(const FractureMap::Label& label, Fragment& fragment) {
    if (!label.material.empty()) fragment.material = label.material;
    if (label.density) fragment.density = *label.density;
    if (label.strength) fragment.strength = *label.strength;
    if (label.toughness) fragment.toughness = *label.toughness;
}

void applyBelow(const FractureMap::Label& label, uint32_t fragment, FractureSet& set) {
    apply(label, set.fragments[fragment]);
    const Range children = set.fragments[fragment].children;
    for (uint32_t c = children.first; c < children.first + children.count; ++c)
        applyBelow(label, c, set);
}

}  // namespace

std::vector<PlacedLabel> placeLabels(const SurfaceMesh& mesh, const CutSurface& cut,
                                     const FracturePlan& plan, double snapDistance,
                                     std::vector<BakeFinding>& findings) {
    std::vector<const FractureMap::Label*> labels;
    for (const FracturePlan::Drawing& drawing : plan.drawings)
        for (const FractureMap::Label& label : drawing.map.labels) labels.push_back(&label);
    if (labels.empty()) return {};
    std::vector<UvTriangle> uv;
    if (auto frames = snapUv(mesh)) uv = std::move(*frames);
    const PlaceFinder finder(mesh, cut.surface, cut.topology.degenerate, uv);
    std::vector<PlacedLabel> placed;
    for (const FractureMap::Label* label : labels) {
        const std::optional<SurfacePoint> point = finder.find(label->place);
        if (point && point->distance <= snapDistance)
            placed.push_back(
                {label, point->triangle,
                 label->level == 0 ? cut.lines.levels() : cut.lines.closedUp(label->level)});
        else
            findings.push_back({"label", "a label lies on no component; move it onto the surface",
                                label->source, 1});
    }
    return placed;
}

std::vector<std::string> assembleLabels(std::vector<PlacedLabel> labels,
                                        const Components& components, const Hierarchy& hierarchy,
                                        FractureSet& set) {
    std::vector<std::string> problems;
    std::stable_sort(labels.begin(), labels.end(), [&](const PlacedLabel& a, const PlacedLabel& b) {
        return hierarchy.level[fragmentOf(a, components, hierarchy)] <
               hierarchy.level[fragmentOf(b, components, hierarchy)];
    });
    for (const PlacedLabel& placed : labels) {
        const uint32_t f = fragmentOf(placed, components, hierarchy);
        const FractureMap::Label& label = *placed.label;
        Fragment& fragment = set.fragments[f];
        if (!label.name.empty() && !fragment.name.empty() && fragment.name != label.name)
            problems.push_back("\"" + fragment.name + "\" and \"" + label.name +
                               "\" name the same fragment; the latter stands (" + label.source +
                               ")");
        if (!label.name.empty()) fragment.name = label.name;
        applyBelow(label, f, set);
    }
    return problems;
}

void assembleAnchors(const std::vector<PlacedLabel>& labels, const SplitSurface& surface,
                     const Components& components, const Hierarchy& hierarchy, FractureSet& set) {
    struct Outside {
        double area = 0;
        glm::dvec3 moment{0.0}, normal{0.0};
    };
    std::map<uint32_t, Outside> anchored;  // by leaf
    for (const PlacedLabel& placed : labels) {
        if (!placed.label->anchor) continue;
        const Range leaves = hierarchy.leaves[fragmentOf(placed, components, hierarchy)];
        for (uint32_t r = leaves.first; r < leaves.first + leaves.count; ++r)
            anchored[hierarchy.leafOrder[r]];
    }
    if (anchored.empty()) return;
    for (uint32_t t = 0; t < surface.triangles.size(); ++t) {
        const auto found = anchored.find(components.leaf[t]);
        if (found == anchored.end()) continue;
        const auto& v = surface.triangles[t].v;
        const glm::dvec3 a = surface.positions[v[0]];
        const glm::dvec3 b = surface.positions[v[1]];
        const glm::dvec3 c = surface.positions[v[2]];
        const glm::dvec3 normal = 0.5 * glm::cross(b - a, c - a);
        const double area = glm::length(normal);
        found->second.area += area;
        found->second.moment += (a + b + c) * (area / 3);
        found->second.normal += normal;
    }
    for (const auto& [leaf, outside] : anchored) {
        if (!(outside.area > 0)) continue;
        const uint32_t f = hierarchy.fragmentOfRank[hierarchy.rankOfLeaf[leaf]];
        const double length = glm::length(outside.normal);
        Bond bond;
        bond.a = static_cast<int32_t>(f);
        bond.b = -1;
        bond.area = static_cast<float>(0.5 * outside.area);
        bond.centroid = glm::vec3(outside.moment / outside.area);
        // A leaf that is all around has no side of its own: it stands.
        bond.normal =
            length > 1e-6 * outside.area ? glm::vec3(outside.normal / length) : glm::vec3(0, -1, 0);
        bond.strength = set.fragments[f].strength;
        bond.toughness = set.fragments[f].toughness;
        set.bonds.push_back(bond);
    }
}

}  // namespace sherd
