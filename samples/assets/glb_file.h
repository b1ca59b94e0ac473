// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "sample_object.h"
#include "sherd/formats/gltf_document.h"

namespace sherd::samples {

/// One node, one mesh, a material for its skin and one for its inside, everything in buffer 0.
GltfDocument toGltf(const SampleObject& object);

/// How to bake the object: its two maps, its inside material, its density (JSON).
std::string toRecipe(const SampleObject& object);

/// The name of the material for broken faces.
std::string insideMaterialName(const SampleObject& object);

}  // namespace sherd::samples
