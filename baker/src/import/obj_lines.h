// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "import/obj_parse.h"
#include "sherd/baker/surface_mesh.h"

namespace sherd {

/// The `l` elements of a file as lines to cut along. `name`: the file. What was dropped is reported
/// in `warnings`.
std::vector<FractureMap::SurfaceLine> makeObjLines(const ObjFile& file, const std::string& name,
                                                   std::vector<std::string>& warnings);

}  // namespace sherd
