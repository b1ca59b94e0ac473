// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/vec2.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sherd/formats/result.h"

namespace sherd {

/// Lines as drawn: an undirected graph in UV space (v down, [0,1]^2 is the SVG's viewBox), curves
/// already flattened. Lines may cross, overlap and repeat: `planarise` sorts that out exactly.
struct FractureMap {
    struct Line {
        std::vector<glm::dvec2> points;  ///< at least 2; a closed line repeats its first point
        uint32_t level = 1;              ///< the level from which it cuts
        std::string source;  ///< where it comes from, for reports: "a.svg: path #crack3"
    };
    std::vector<Line> lines;
    std::vector<std::string> warnings;  ///< what was ignored and why, a sentence each
};

struct MapReadOptions {
    uint32_t level = 1;  ///< level of every line that does not say otherwise
    double tolerance =
        1e-4;  ///< largest distance between a curve and its flattened line, in UV units
};

/// Reads `.svg` or `.json` (Sherd's map format). An empty map is an error (`emptyMap`).
Result<FractureMap> readFractureMap(const std::filesystem::path& path,
                                    const MapReadOptions& options);
Result<FractureMap> readSvgMap(std::string_view text, const std::string& name,
                               const MapReadOptions& options);
Result<FractureMap> readJsonMap(std::string_view text, const std::string& name,
                                const MapReadOptions& options);

}  // namespace sherd
