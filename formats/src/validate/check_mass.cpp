// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "check_context.h"

namespace sherd {

namespace {

bool differ(double a, double b, double relative) {
    return std::abs(a - b) > relative * std::max(std::abs(a), std::abs(b));
}

void checkLeafMass(CheckContext& context, uint32_t f) {
    const Fragment& leaf = context.set.fragments[f];
    if (differ(leaf.mass, double{leaf.density} * leaf.volume, 1e-3))
        context.find(Severity::failure, "mass_wrong", static_cast<int32_t>(f),
                     "MASS says " + shortNumber(leaf.mass) + " kg, DENSITY times VOLUME is " +
                         shortNumber(double{leaf.density} * leaf.volume),
                     "/fragments/attributes/MASS");
}

void checkMassSum(CheckContext& context, uint32_t f) {
    const Fragment& parent = context.set.fragments[f];
    double mass = 0;
    double volume = 0;
    float thinnest = parent.density;
    float densest = 0;
    for (uint32_t c = 0; c < parent.children.count; ++c) {
        const Fragment& child = context.set.fragments[parent.children.first + c];
        mass += child.mass;
        volume += child.volume;
        thinnest = c == 0 ? child.density : std::min(thinnest, child.density);
        densest = std::max(densest, child.density);
    }
    const auto id = static_cast<int32_t>(f);
    if (differ(parent.mass, mass, 1e-4))
        context.find(
            Severity::failure, "mass_sum", id,
            "MASS says " + shortNumber(parent.mass) + " kg, its children have " + shortNumber(mass),
            "/fragments/attributes/MASS");
    // Core and all, or the pieces alone: either is a volume of the object.
    const bool isMeshVolume = f == 0 && !differ(parent.volume, context.measures[0].volume, 1e-3);
    if (differ(parent.volume, volume, 1e-4) && !isMeshVolume)
        context.find(Severity::failure, "volume_wrong", id,
                     "VOLUME says " + shortNumber(parent.volume) + " m^3, its children have " +
                         shortNumber(volume),
                     "/fragments/attributes/VOLUME");
    if (parent.density < thinnest * (1 - 1e-4F) || parent.density > densest * (1 + 1e-4F))
        context.find(Severity::failure, "density_wrong", id,
                     "DENSITY says " + shortNumber(parent.density) +
                         " kg/m^3, its children's are from " + shortNumber(thinnest) + " to " +
                         shortNumber(densest),
                     "/fragments/attributes/DENSITY");
}

}  // namespace

void checkMass(CheckContext& context) {
    for (uint32_t f = 0; f < context.set.fragments.size(); ++f) {
        if (context.set.fragments[f].children.count > 0)
            checkMassSum(context, f);
        else
            checkLeafMass(context, f);
    }
}

}  // namespace sherd
