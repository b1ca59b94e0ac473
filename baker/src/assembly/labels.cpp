// SPDX-License-Identifier: MIT
#include "assembly/labels.h"

#include <algorithm>

#include "assembly/piece_materials.h"
#include "surface/surface_point.h"

namespace sherd {
namespace {

using Materials = std::map<std::string, PhysicalMaterial>;

void apply(const FractureMap::Label& label, const Materials& materials, Fragment& fragment) {
    if (!label.material.empty()) fragment.material = label.material;
    if (const auto said = materials.find(label.material); said != materials.end())
        apply(said->second, fragment);
    if (label.density) fragment.density = *label.density;
    if (label.strength) fragment.strength = *label.strength;
    if (label.toughness) fragment.toughness = *label.toughness;
}

void applyBelow(const FractureMap::Label& label, const Materials& materials, uint32_t fragment,
                FractureSet& set) {
    apply(label, materials, set.fragments[fragment]);
    const Range children = set.fragments[fragment].children;
    for (uint32_t c = children.first; c < children.first + children.count; ++c)
        applyBelow(label, materials, c, set);
}

}  // namespace

uint32_t fragmentOf(const PlacedLabel& placed, const Components& components,
                    const Hierarchy& hierarchy) {
    uint32_t fragment =
        hierarchy.fragmentOfRank[hierarchy.rankOfLeaf[components.leaf[placed.triangle]]];
    while (hierarchy.level[fragment] > placed.level)
        fragment = static_cast<uint32_t>(hierarchy.parent[fragment]);
    return fragment;
}

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
                                        const std::map<std::string, PhysicalMaterial>& materials,
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
        applyBelow(label, materials, f, set);
    }
    return problems;
}

}  // namespace sherd
