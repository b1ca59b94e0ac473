// SPDX-License-Identifier: MIT
// What labels say of the fragments that hold their places.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "assembly/hierarchy.h"
#include "sherd/baker/fracture_map.h"
#include "sherd/baker/recipe.h"
#include "surface/cut_surface.h"

namespace sherd {

/// A label and the triangle of the cut surface its place lies on.
struct PlacedLabel {
    const FractureMap::Label* label = nullptr;
    uint32_t triangle = 0;
    uint32_t level = 0;  ///< of the fragment meant, as levels are closed up
};

/// Finds the labels of a plan's drawings on the surface; those farther than `snapDistance` metres
/// off it are left out with a finding.
std::vector<PlacedLabel> placeLabels(const SurfaceMesh& mesh, const CutSurface& cut,
                                     const FracturePlan& plan, double snapDistance,
                                     std::vector<BakeFinding>& findings);

/// The fragment that holds the place at the label's level.
uint32_t fragmentOf(const PlacedLabel& placed, const Components& components,
                    const Hierarchy& hierarchy);

/// Names, materials and numbers go to the labelled fragment and all it consists of; of several
/// labels those of deeper levels, then later ones, win; numbers of a label over those of
/// `materials` that go by the material it names. Returns what contradicts, a sentence each.
std::vector<std::string> assembleLabels(std::vector<PlacedLabel> labels,
                                        const Components& components, const Hierarchy& hierarchy,
                                        const std::map<std::string, PhysicalMaterial>& materials,
                                        FractureSet& set);

}  // namespace sherd
