// SPDX-License-Identifier: MIT
// Drawings whose centre lines are known: drawn in the test, compared with what was traced.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "sherd/baker/fracture_map.h"
#include "support/property.h"

namespace sherd::test {

using Polyline = std::vector<glm::dvec2>;

/// Lines in texels, split at their nodes; a closed one repeats its first point.
struct Drawing {
    int width = 0, height = 0;
    std::vector<Polyline> lines;
};

struct Brush {
    double width = 3;  ///< texels
    bool antialiased = true;
    bool square = false;  ///< loose ends are cut off square instead of round
};

/// Rows of darkness, 255 where lines cover a texel.
std::vector<uint8_t> coverage(const Drawing& drawing, const Brush& brush);

/// Grey from ground (coverage 0) to ink (255), with normally distributed noise of `sigma`.
std::vector<uint8_t> shades(const std::vector<uint8_t>& coverage, int ground, int ink, double sigma,
                            Random& random);

std::vector<uint8_t> greyPng(const Drawing& drawing, const std::vector<uint8_t>& grey);
std::vector<uint8_t> greyJpeg(const Drawing& drawing, const std::vector<uint8_t>& grey,
                              int quality);

/// Black on white, no noise.
std::vector<uint8_t> plainPng(const Drawing& drawing, const Brush& brush);

/// A map's lines in texels.
std::vector<Polyline> inTexels(const FractureMap& map, const Drawing& drawing);

struct GraphCounts {
    size_t nodes = 0;  ///< of a degree other than 2
    size_t edges = 0;  ///< between those, and closed lines without any
    size_t loose = 0;  ///< nodes of degree 1
    bool operator==(const GraphCounts&) const = default;
};
/// Lines are connected where their ends are the same.
GraphCounts countGraph(const std::vector<Polyline>& lines);

/// The largest distance of a point on `from` to `to`, to a quarter of a texel along the lines.
double furthest(const std::vector<Polyline>& from, const std::vector<Polyline>& to);
double hausdorff(const std::vector<Polyline>& a, const std::vector<Polyline>& b);

/// A graph without crossings whose nodes and lines are far enough apart for lines `width` wide.
Drawing randomDrawing(Random& random, double width);

}  // namespace sherd::test
