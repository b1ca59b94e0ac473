// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>

namespace sherd {

/// One number for an edge, whichever way it runs.
inline uint64_t edgeKey(uint32_t a, uint32_t b) {
    return uint64_t{std::min(a, b)} << 32 | std::max(a, b);
}

}  // namespace sherd
