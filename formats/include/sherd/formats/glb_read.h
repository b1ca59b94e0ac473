// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "sherd/formats/fracture_set.h"
#include "sherd/formats/result.h"

namespace sherd {

/// The fracture sets of a baked GLB. Never trusts the bytes: every index, count, offset and number
/// is checked; errors carry the JSON pointer of the culprit. A file without the extension gives an
/// empty vector.
Result<std::vector<FractureSet>> readFractureSets(std::span<const uint8_t> glb);
Result<std::vector<FractureSet>> readFractureSets(const std::filesystem::path& path);

}  // namespace sherd
