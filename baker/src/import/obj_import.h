// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string_view>

#include "sherd/baker/import.h"

namespace sherd {

/// An OBJ text as one mesh, and the glTF document made for it. `path` names the file in errors and
/// is where material files and textures are looked up.
Result<Model> importObj(std::string_view text, const std::filesystem::path& path,
                        const ImportOptions& options);

}  // namespace sherd
