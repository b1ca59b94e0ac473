// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sherd/formats/result.h"

namespace sherd {

/// What a line says of the bonds it makes; what it leaves open comes from the recipe.
struct LineProperties {
    std::optional<float> strength;   ///< Pa, finite, at least 0
    std::optional<float> toughness;  ///< J/m^2, finite, at least 0
};

/// A place on the object: in the drawing's own coordinates, or a point in 3D that the nearest
/// point of the surface stands for.
struct SurfacePlace {
    bool in3d = false;
    glm::dvec3 point{0.0};  ///< in3d: scene coordinates, metres; else (u, v, 0)
};

/// Lines as drawn: an undirected graph in UV space (v down, [0,1]^2 is the SVG's viewBox), curves
/// already flattened. Lines may cross, overlap and repeat: `planarise` sorts that out exactly.
struct FractureMap {
    struct Line {
        std::vector<glm::dvec2> points;  ///< at least 2; a closed line repeats its first point
        uint32_t level = 1;              ///< the level from which it cuts
        std::string source;  ///< where it comes from, for reports: "a.svg: path #crack3"
        LineProperties properties = {};
    };
    /// A line that runs over the surface from place to place, across triangles and chart borders.
    struct SurfaceLine {
        std::vector<SurfacePlace> places;  ///< at least 2; a closed line repeats its first place
        uint32_t level = 1;
        std::string source;
        LineProperties properties = {};
    };
    /// A word about the component that holds a place.
    struct Label {
        SurfacePlace place = {};
        uint32_t level = 0;              ///< of the component meant; 0: the deepest
        std::string name;                ///< "": keeps none
        std::string material;            ///< physical material, a word for the game; "": none
        std::optional<float> density;    ///< kg/m^3, above 0
        std::optional<float> strength;   ///< Pa
        std::optional<float> toughness;  ///< J/m^2
        bool anchor = false;             ///< fixed to the world
        std::string source;
    };
    std::vector<Line> lines;
    std::vector<SurfaceLine> surfaceLines;
    std::vector<Label> labels;
    std::vector<std::string> warnings;  ///< what was ignored and why, a sentence each

    bool empty() const { return lines.empty() && surfaceLines.empty(); }
};

/// How a bitmap of dark lines becomes a map. Lengths in texels.
struct BitmapOptions {
    std::optional<double> threshold;  ///< 0..1, darker is line; none: found (Otsu 1979)
    double tolerance = 0.5;           ///< largest distance from a traced line to its simplified one
    double spur = 4;                  ///< shorter dead branches are taken for noise and left out
    bool curves = false;              ///< fit smooth curves through the simplified lines
};

struct MapReadOptions {
    uint32_t level = 1;  ///< level of every line that does not say otherwise
    double tolerance =
        1e-4;  ///< largest distance between a curve and its flattened line, in UV units
    /// Stroke colours that choose the level: "#ff0000" -> 2. Empty: colours say nothing.
    std::vector<std::pair<std::string, uint32_t>> levelOfColor = {};
    BitmapOptions bitmap = {};
};

/// Reads `.svg`, `.json` (Sherd's map format), `.png` or `.jpg`. An empty map is an error
/// (`emptyMap`).
Result<FractureMap> readFractureMap(const std::filesystem::path& path,
                                    const MapReadOptions& options);
Result<FractureMap> readSvgMap(std::string_view text, const std::string& name,
                               const MapReadOptions& options);
Result<FractureMap> readJsonMap(std::string_view text, const std::string& name,
                                const MapReadOptions& options);
/// The bytes of a PNG or JPEG: dark lines on light, or opaque ones on transparent.
Result<FractureMap> readBitmapMap(std::span<const uint8_t> bytes, const std::string& name,
                                  const MapReadOptions& options);

}  // namespace sherd
