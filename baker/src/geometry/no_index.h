// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace sherd {

/// The index of nothing: of no vertex, half edge, triangle or piece.
inline constexpr uint32_t kNone = 0xFFFFFFFFU;

}  // namespace sherd
