// SPDX-License-Identifier: MIT
#include "import/level_name.h"

#include "map/level_word.h"

namespace sherd {

std::optional<uint32_t> levelInName(std::string_view name) {
    // Blender counts its duplicates behind a dot: "level.001" is a copy of "level".
    constexpr std::string_view kBetween = " _-:#";
    for (auto word = findLevelWord(name, 0, kBetween); word;
         word = findLevelWord(name, word->end, kBetween)) {
        if (word->level > 0) return word->level;
    }
    return std::nullopt;
}

}  // namespace sherd
