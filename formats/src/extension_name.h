// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace sherd {

constexpr const char* kExtensionName = "SHERD_mesh_fracture";
constexpr int kExtensionVersion = 1;
constexpr uint32_t kNoFragment = 0xFFFFFFFF;  ///< in PARENT: the object; in FRAGMENTS: the world

// glTF component types.
constexpr uint32_t kUnsignedInt = 5125;
constexpr uint32_t kFloat = 5126;

}  // namespace sherd
