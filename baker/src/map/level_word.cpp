// SPDX-License-Identifier: MIT
#include "map/level_word.h"

#include <algorithm>

#include "map/map_limits.h"
#include "map/map_text.h"

namespace sherd {
namespace {

constexpr std::string_view kWord = "level";

/// Letters beyond ASCII are letters, too.
bool isLetter(char c) {
    return isLetterChar(c) || (static_cast<unsigned char>(c) & 0x80U) != 0;
}

bool standsAt(std::string_view name, size_t at) {
    if (name.size() - at < kWord.size()) return false;
    for (size_t i = 0; i < kWord.size(); ++i)
        if (lowerChar(name[at + i]) != kWord[i]) return false;
    if (at == 0 || !isLetter(name[at - 1])) return true;
    return name[at] == 'L' && name[at - 1] == lowerChar(name[at - 1]);
}

}  // namespace

std::optional<LevelWord> findLevelWord(std::string_view name, size_t from,
                                       std::string_view between) {
    for (size_t at = from; at < name.size(); ++at) {
        if (!standsAt(name, at)) continue;
        const size_t end = at + kWord.size();
        std::string_view rest = name.substr(end);
        rest.remove_prefix(std::min(rest.find_first_not_of(between), rest.size()));
        size_t digits = 0;
        while (digits < rest.size() && isDigitChar(rest[digits])) ++digits;
        if (digits == 0) continue;
        const uint32_t level = parseSmallNumber(rest.substr(0, digits)).value_or(0);
        return LevelWord{level <= kMaxMapLevel ? level : 0, end};
    }
    return std::nullopt;
}

}  // namespace sherd
