// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "sherd/formats/result.h"

namespace sherd {

/// The bytes of a regular file. Tells "not there" from "cannot be read".
Result<std::vector<uint8_t>> readFileWhole(const std::filesystem::path& path);

}  // namespace sherd
