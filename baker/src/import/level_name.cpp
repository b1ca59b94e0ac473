// SPDX-License-Identifier: MIT
#include "import/level_name.h"

#include "map/map_limits.h"

namespace sherd {
namespace {

constexpr std::string_view kWord = "level";

bool isDigit(char c) {
    return c >= '0' && c <= '9';
}
bool isUpper(char c) {
    return c >= 'A' && c <= 'Z';
}
bool isLetter(char c) {
    return isUpper(c) || (c >= 'a' && c <= 'z') || (static_cast<unsigned char>(c) & 0x80U) != 0;
}

bool isWordAt(std::string_view name, size_t at) {
    if (name.size() - at < kWord.size()) return false;
    for (size_t i = 0; i < kWord.size(); ++i) {
        const char c = name[at + i];
        if ((isUpper(c) ? static_cast<char>(c - 'A' + 'a') : c) != kWord[i]) return false;
    }
    // "sublevel 2" is another word; "crackLevel2" is two.
    if (at == 0 || !isLetter(name[at - 1])) return true;
    return isUpper(name[at]) && !isUpper(name[at - 1]);
}

/// The number behind the word. Blender counts its duplicates behind a dot ("level_2.001"): a dot
/// ends the number.
std::optional<uint32_t> numberAt(std::string_view name, size_t at) {
    while (at < name.size() && std::string_view(" _-:#").find(name[at]) != std::string_view::npos) {
        ++at;
    }
    if (at == name.size() || !isDigit(name[at])) return std::nullopt;
    uint32_t level = 0;
    for (; at < name.size() && isDigit(name[at]); ++at) {
        level = 10 * level + static_cast<uint32_t>(name[at] - '0');
        if (level > kMaxMapLevel) return std::nullopt;
    }
    return level > 0 ? std::optional(level) : std::nullopt;
}

}  // namespace

std::optional<uint32_t> levelInName(std::string_view name) {
    for (size_t at = 0; at < name.size(); ++at) {
        if (!isWordAt(name, at)) continue;
        if (const auto level = numberAt(name, at + kWord.size())) return level;
    }
    return std::nullopt;
}

}  // namespace sherd
