// SPDX-License-Identifier: MIT
// Parts of texts like "voronoi:12:7:around=0,1,0", as command lines and recipes have them.
#pragma once

#include <charconv>
#include <cmath>
#include <glm/vec3.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace sherd {

inline std::vector<std::string_view> split(std::string_view text, char separator) {
    std::vector<std::string_view> parts;
    for (size_t at = 0;;) {
        const size_t end = text.find(separator, at);
        parts.push_back(text.substr(at, end - at));
        if (end == std::string_view::npos) return parts;
        at = end + 1;
    }
}

/// Whether all of the text is the number.
template <class Number>
bool readNumber(std::string_view text, Number& number) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    return error == std::errc() && end == text.data() + text.size();
}

/// "X,Y,Z", finite.
inline bool readVector(std::string_view text, glm::dvec3& vector) {
    const std::vector<std::string_view> parts = split(text, ',');
    if (parts.size() != 3) return false;
    for (int k = 0; k < 3; ++k) {
        if (!readNumber(parts[static_cast<size_t>(k)], vector[k]) || !std::isfinite(vector[k]))
            return false;
    }
    return true;
}

inline std::string quoted(std::string_view text) {
    return std::string("\"").append(text).append("\"");
}

}  // namespace sherd
