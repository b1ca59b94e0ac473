// SPDX-License-Identifier: MIT
#include "sherd/runtime/material.h"

#include <algorithm>
#include <array>

namespace sherd {
namespace {

//                           name     tension  shear compression  J/m^2   m/s   dissipation
constexpr std::array<Material, 8> kMaterials{{{"glass", 40e6F, 0.8F, 20, 8, 5500, 6},
                                              {"porcelain", 45e6F, 0.8F, 12, 20, 5300, 6},
                                              {"brick", 2e6F, 0.7F, 10, 30, 3000, 6},
                                              {"concrete", 3e6F, 0.7F, 10, 80, 3700, 6},
                                              {"stone", 10e6F, 0.7F, 14, 80, 5000, 6},
                                              {"wood", 5e6F, 1.6F, 2, 300, 1500, 4},
                                              {"plaster", 2e6F, 0.7F, 5, 15, 2300, 6},
                                              {"ice", 1e6F, 0.7F, 6, 2, 3800, 6}}};
constexpr Material kOther{"", 1e6F, 0.7F, 10, 50, 3000, 1};

const Material* find(std::string_view name) {
    const auto* found =
        std::find_if(kMaterials.begin(), kMaterials.end(),
                     [name](const Material& material) { return material.name == name; });
    return found == kMaterials.end() ? nullptr : found;
}

}  // namespace

std::span<const Material> materials() {
    return kMaterials;
}

const Material& materialNamed(std::string_view name) {
    const Material* material = find(name);
    return material ? *material : kOther;
}

void applyMaterials(FractureSet& set) {
    for (Fragment& fragment : set.fragments) {
        const Material* material = find(fragment.material);
        if (!material) continue;
        fragment.strength = material->strength;
        fragment.toughness = material->toughness;
    }
    for (Bond& bond : set.bonds) {
        const Fragment& a = set.fragments[size_t(bond.a)];
        const Fragment& b = bond.b < 0 ? a : set.fragments[size_t(bond.b)];
        if (!find(a.material) && !find(b.material)) continue;
        bond.strength = std::min(a.strength, b.strength);
        bond.toughness = std::min(a.toughness, b.toughness);
    }
}

}  // namespace sherd
