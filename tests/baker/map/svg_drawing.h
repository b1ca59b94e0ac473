// SPDX-License-Identifier: MIT
// Small drawings for the tests of the SVG reader.
#pragma once

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "sherd/baker/fracture_map.h"

namespace sherd::test {

inline FractureMap readDrawing(const std::string& text, const MapReadOptions& options = {}) {
    const Result<FractureMap> map = readSvgMap(text, "t.svg", options);
    INFO(text);
    if (!map) FAIL(map.error().message << " " << map.error().where);
    return *map;
}

/// A drawing of 100 by 100 units; `root` is written into the svg element.
inline std::string drawing(const std::string& body, const std::string& root = "") {
    return "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 100 100' " + root + ">" + body +
           "</svg>";
}

inline std::vector<uint32_t> levelsOf(const FractureMap& map) {
    std::vector<uint32_t> levels;
    for (const FractureMap::Line& line : map.lines) levels.push_back(line.level);
    return levels;
}

inline bool warns(const FractureMap& map, const std::string& words) {
    for (const std::string& warning : map.warnings)
        if (warning.find(words) != std::string::npos) return true;
    return false;
}

}  // namespace sherd::test
