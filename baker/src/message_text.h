// SPDX-License-Identifier: MIT
// Words and numbers of messages.
#pragma once

#include <array>
#include <cstdint>
#include <cstdio>
#include <glm/vec3.hpp>
#include <string>

namespace sherd {

inline std::string text(const char* format, auto... values) {
    std::array<char, 192> buffer{};
    std::snprintf(buffer.data(), buffer.size(), format, values...);
    return buffer.data();
}

inline std::string counted(uint32_t count, const char* what) {
    return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

inline std::string at(const glm::dvec3& p) {
    return text("(%.6g, %.6g, %.6g)", p.x, p.y, p.z);
}

}  // namespace sherd
