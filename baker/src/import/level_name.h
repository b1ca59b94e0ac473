// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace sherd {

/// The level that a name says: the word "level" and a number from 1 to kMaxMapLevel, anywhere in
/// it, in any case: "Cracks level 2", "level_2.001", "fracture-Level3". Nothing if it says none.
std::optional<uint32_t> levelInName(std::string_view name);

}  // namespace sherd
