// SPDX-License-Identifier: MIT
// Small words on text that the map readers share.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>

namespace sherd {

constexpr bool isSpaceChar(char c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f';
}

/// ASCII only: the words of SVG, CSS and of level names are.
constexpr char lowerChar(char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

constexpr bool isLetterChar(char c) {
    return lowerChar(c) >= 'a' && lowerChar(c) <= 'z';
}

constexpr bool isDigitChar(char c) {
    return c >= '0' && c <= '9';
}

inline std::string_view trim(std::string_view text) {
    while (!text.empty() && isSpaceChar(text.front())) text.remove_prefix(1);
    while (!text.empty() && isSpaceChar(text.back())) text.remove_suffix(1);
    return text;
}

inline std::string lowered(std::string_view text) {
    std::string out(text);
    std::transform(out.begin(), out.end(), out.begin(), lowerChar);
    return out;
}

inline bool startsWith(std::string_view text, std::string_view start) {
    return text.substr(0, start.size()) == start;
}

/// Calls `visit` for each part of `text` between separators, trimmed.
template <class Visit>
void forEachPart(std::string_view text, char separator, const Visit& visit) {
    while (!text.empty()) {
        const size_t end = std::min(text.find(separator), text.size());
        visit(trim(text.substr(0, end)));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
}

/// At most `bytes` of it, never half a UTF-8 character; "..." stands for the rest.
std::string shortened(std::string_view text, size_t bytes);

/// A finite number of at least 0 that a float holds, and nothing else.
std::optional<float> parseQuantity(std::string_view text);

/// A whole number of up to three digits, and nothing else.
std::optional<uint32_t> parseSmallNumber(std::string_view text);

}  // namespace sherd
