// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "sherd/formats/fracture_set.h"

namespace sherd {

/// How a substance breaks. Values are typical ones of textbooks: M. F. Ashby, "Materials Selection
/// in Mechanical Design" (2011), appendix A; ice: E. M. Schulson, P. Duval, "Creep and Fracture of
/// Ice" (2009).
struct Material {
    std::string_view name;
    float strength = 0;     ///< in tension, Pa
    float shear = 0;        ///< share of it that a bond holds in shear,
    float compression = 0;  ///< and in compression, the strongest of brittle things
    float toughness = 0;    ///< to make a crack slowly, J per m^2 of bond
    float soundSpeed = 0;   ///< m/s
    /// Times `toughness`: what breaking fast consumes. A fast crack branches, and makes about six
    /// times the surface: E. Sharon, S. P. Gross, J. Fineberg, "Energy Dissipation in Dynamic
    /// Fracture" (1996).
    float dissipation = 1;
};

/// Glass, porcelain, brick, concrete, stone, wood, plaster, ice.
std::span<const Material> materials();

/// The preset of that name, or one for anything else: dissipation 1, so that a file's toughness is
/// what breaking consumes.
const Material& materialNamed(std::string_view name);

/// Writes the strength and toughness of presets over those of all fragments whose material has one,
/// and of the bonds between: of two materials the weaker counts. For an object baked with names
/// only.
void applyMaterials(FractureSet& set);

}  // namespace sherd
