// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace sherd {

/// A number after the word "level".
struct LevelWord {
    uint32_t level = 0;  ///< 1 to kMaxMapLevel; 0: the number is no level
    size_t end = 0;      ///< where the word ends in the name, its number not yet read
};

/// The first at or after `from`, in any case: the word stands alone ("sublevel 2" is another one)
/// unless a capital sets it apart ("crackLevel2"). between: characters that may stand before the
/// number.
std::optional<LevelWord> findLevelWord(std::string_view name, size_t from,
                                       std::string_view between);

}  // namespace sherd
