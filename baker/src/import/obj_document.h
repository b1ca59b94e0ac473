// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "import/obj_materials.h"
#include "sherd/baker/surface_mesh.h"
#include "sherd/formats/gltf_document.h"

namespace sherd {

/// A glTF document showing `mesh` as mesh 0 in node 0, its materials being `materials` in order.
GltfDocument makeDocument(const SurfaceMesh& mesh, const std::vector<ObjMaterial>& materials);

}  // namespace sherd
