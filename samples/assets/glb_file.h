// SPDX-License-Identifier: MIT
#pragma once

#include "sample_object.h"
#include "sherd/formats/gltf_document.h"

namespace sherd::samples {

/// One node, one mesh, one material, everything in buffer 0.
GltfDocument toGltf(const SampleObject& object);

}  // namespace sherd::samples
