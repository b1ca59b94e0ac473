// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace sherd {

/// Most vertices or triangles one imported mesh may have.
inline constexpr uint64_t kMaxImportElements = uint64_t{1} << 26;

}  // namespace sherd
