// SPDX-License-Identifier: MIT
// Scenes that were not modelled in metres.
#pragma once

#include <string>

#include "sherd/formats/gltf_document.h"

namespace sherd {

/// Puts everything a scene shows below one new node that scales it: meshes, animations and the
/// numbers of nodes stay as they were, and the scene is in metres, as glTF demands. A document that
/// has such a node already gets the new scale on it. `metres` per unit, above 0.
/// Errors: invalidData, unsupported (scenes that share nodes).
Result<void> scaleScenes(GltfDocument& document, const std::string& name, double metres);

}  // namespace sherd
