// SPDX-License-Identifier: MIT
#include "map/map_text.h"

#include <limits>

#include "map/svg_scanner.h"

namespace sherd {

std::string shortened(std::string_view text, size_t bytes) {
    if (text.size() <= bytes) return std::string(text);
    const auto continues = [&](size_t i) { return (text[i] & '\xC0') == '\x80'; };
    while (bytes > 0 && continues(bytes)) --bytes;
    return std::string(text.substr(0, bytes)) + "...";
}

std::optional<float> parseQuantity(std::string_view text) {
    SvgScanner scanner(trim(text));
    const std::optional<double> value = scanner.number();
    if (!value || !scanner.atEnd()) return std::nullopt;
    if (!(*value >= 0) || *value > std::numeric_limits<float>::max()) return std::nullopt;
    return static_cast<float>(*value);
}

std::optional<uint32_t> parseSmallNumber(std::string_view text) {
    text = trim(text);
    if (text.empty() || text.size() > 3) return std::nullopt;
    uint32_t value = 0;
    for (const char c : text) {
        if (!isDigitChar(c)) return std::nullopt;
        value = 10 * value + static_cast<uint32_t>(c - '0');
    }
    return value;
}

}  // namespace sherd
