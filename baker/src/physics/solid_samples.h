// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "physics/solid_chain.h"

namespace sherd {

/// Points inside the solid in rows along the axes, `cells` along its longest side and at least a
/// quarter of that along the others.
std::vector<glm::dvec3> solidSamples(const SolidChain& solid, uint32_t cells);

}  // namespace sherd
