// SPDX-License-Identifier: MIT
// What labels say of the fragments that hold their places.
#pragma once

#include <string>
#include <vector>

#include "assembly/hierarchy.h"
#include "sherd/baker/fracture_map.h"
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

/// Names, materials and numbers go to the labelled fragment and all it consists of; of several
/// labels those of deeper levels, then later ones, win. Returns what contradicts, a sentence each.
std::vector<std::string> assembleLabels(std::vector<PlacedLabel> labels,
                                        const Components& components, const Hierarchy& hierarchy,
                                        FractureSet& set);

/// One bond to the world for every leaf of an anchored fragment: half the leaf's outer surface, at
/// its middle. Appends to the set's bonds.
void assembleAnchors(const std::vector<PlacedLabel>& labels, const SplitSurface& surface,
                     const Components& components, const Hierarchy& hierarchy, FractureSet& set);

}  // namespace sherd
