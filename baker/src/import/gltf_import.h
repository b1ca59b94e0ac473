// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "sherd/baker/import.h"

namespace sherd {

/// The chosen mesh nodes of a document. `name`: the file, for errors.
Result<std::vector<SurfaceMesh>> importGltf(const GltfDocument& document, const std::string& name,
                                            const ImportOptions& options);

}  // namespace sherd
