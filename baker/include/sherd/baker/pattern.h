// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sherd/baker/projection.h"
#include "sherd/formats/result.h"

namespace sherd {

/// Of one level. More than any engine simulates; far beyond it a slip of the pen would fill the
/// memory.
inline constexpr uint32_t kMostPieces = 100'000;

/// A generated fracture pattern: fracture lines without a drawing, on any mesh.
struct Pattern {
    enum class Kind : uint8_t {
        voronoi,  ///< cells around points spread over the surface (Euclidean bisectors)
        grid,     ///< columns x rows, or bricks
        radial,   ///< sectors and rings around a point, as glass breaks
        wood      ///< splinters: Voronoi cells drawn out along the grain
    };
    Kind kind = Kind::voronoi;
    uint32_t count = 12;   ///< voronoi, wood: pieces of the level in all; 1 to 100,000
    uint32_t columns = 4;  ///< grid: columns; radial: sectors; 1 to 1,000
    uint32_t rows = 4;     ///< grid: rows; radial: rings; 1 to 1,000; columns x rows to 100,000
    uint32_t seed = 1;     ///< the same seed gives the same lines
    double jitter = -1;    ///< 0 to 1: how unevenly lines lie; negative: 0 for grids, else 0.5
    bool brick = false;    ///< grid: every other row is shifted by half a column
    Projection projection{Projection::Kind::planar, glm::dvec3(0.0)};  ///< grid: how the page lies
    std::vector<glm::dvec3> around;    ///< voronoi: crowded around these (scene coordinates)
    double spread = 0.2;               ///< of the crowds; share of the diagonal
    std::optional<glm::dvec3> centre;  ///< radial: the point hit; none: the middle
    glm::dvec3 axis{0.0};              ///< radial: normal, wood: grain; zero: chosen by the extent
    double elongation = 6;             ///< wood: length of a splinter over its width; 1 to 1,000
    /// voronoi, wood: where cells crowd: "" evenly, "color" as COLOR_0 is bright, else the file of
    /// a grey picture in UV space (dark: many).
    std::string density;
    std::string text;  ///< as it was asked for, for reports
};

/// A grey picture, row by row from the top.
struct GreyImage {
    uint32_t width = 0, height = 0;
    std::vector<uint8_t> values;  ///< 0 black
};

/// A PNG or JPEG as grey. Errors: fileNotFound, fileRead, malformed, limitExceeded.
Result<GreyImage> readGreyImage(const std::filesystem::path& path);

/// KIND:COUNTS[:SEED][:KEY=VALUE]...: "voronoi:12", "voronoi:50:7:around=0,1,0:spread=0.1",
/// "grid:4x3:brick:on=box", "radial:12x4:1:at=0,1,0:axis=z", "wood:20:3:axis=y:elongation=8". Error
/// badArgument says what is known and allowed.
Result<Pattern> parsePattern(std::string_view text);

}  // namespace sherd
