// SPDX-License-Identifier: MIT
#include "layout/svg_text.h"

#include <array>
#include <charconv>

namespace sherd {

namespace {

/// The bytes of the UTF-8 character that begins here, 0 if none does.
size_t characterLength(std::string_view text) {
    const auto byte = [&](size_t i) { return static_cast<unsigned char>(text[i]); };
    const size_t length = byte(0) < 0xC2   ? 0
                          : byte(0) < 0xE0 ? 2
                          : byte(0) < 0xF0 ? 3
                          : byte(0) < 0xF5 ? 4
                                           : 0;
    if (length == 0 || length > text.size()) return 0;
    for (size_t i = 1; i < length; ++i)
        if ((byte(i) & 0xC0U) != 0x80) return 0;
    const bool tooLong = (byte(0) == 0xE0 && byte(1) < 0xA0) || (byte(0) == 0xF0 && byte(1) < 0x90);
    const bool surrogate = byte(0) == 0xED && byte(1) >= 0xA0;
    const bool beyond = byte(0) == 0xF4 && byte(1) >= 0x90;
    const bool noCharacter = byte(0) == 0xEF && byte(1) == 0xBF && byte(2) >= 0xBE;
    return tooLong || surrogate || beyond || noCharacter ? 0 : length;
}

}  // namespace

void addNumber(double value, std::string& out) {
    std::array<char, 32> buffer{};
    const auto [end, error] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value,
                                            std::chars_format::fixed, 2);
    if (error != std::errc()) return;  // a UV beyond 1e20 is no place on the page
    out.append(buffer.data(), end);
}

std::string svgNumber(double value) {
    std::string out;
    addNumber(value, out);
    return out;
}

std::string escaped(std::string_view text) {
    std::string out;
    out.reserve(text.size());
    for (size_t i = 0; i < text.size();) {
        const char c = text[i];
        if (static_cast<unsigned char>(c) >= 0x80) {
            const size_t length = characterLength(text.substr(i));
            out += length == 0 ? "\xEF\xBF\xBD" : text.substr(i, length);
            i += length == 0 ? 1 : length;
            continue;
        }
        ++i;
        if (c == '&')
            out += "&amp;";
        else if (c == '<')
            out += "&lt;";
        else if (c == '>')
            out += "&gt;";
        else if (c == '"')
            out += "&quot;";
        else if (static_cast<unsigned char>(c) >= 0x20)
            out += c;
    }
    return out;
}

void addChain(std::span<const glm::dvec2> chain, double size, std::string& out) {
    char separator = 'M';
    for (const glm::dvec2& p : chain) {
        out += separator;
        addNumber(p.x * size, out);
        out += ' ';
        addNumber(p.y * size, out);
        separator = ' ';
    }
}

}  // namespace sherd
