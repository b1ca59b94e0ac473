// SPDX-License-Identifier: MIT
#pragma once

#include <glm/vec2.hpp>
#include <span>
#include <string>
#include <string_view>

namespace sherd {

/// A number with two decimals; nothing for one that is no place on a page.
void addNumber(double value, std::string& out);
std::string svgNumber(double value);

/// Text as content or attribute; what XML cannot hold is left out or replaced.
std::string escaped(std::string_view text);

/// "M x y x y ...": a polyline of page coordinates on a page of that size.
void addChain(std::span<const glm::dvec2> chain, double size, std::string& out);

}  // namespace sherd
