// SPDX-License-Identifier: MIT
#include "bitmap_drawing.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numeric>
#include <utility>

#include "support/png_bytes.h"

#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STBI_WRITE_NO_STDIO
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#include <stb/stb_image_write.h>
#pragma GCC diagnostic pop

namespace sherd::test {

namespace {

double cross(glm::dvec2 a, glm::dvec2 b) {
    return a.x * b.y - a.y * b.x;
}

double distance(glm::dvec2 p, glm::dvec2 a, glm::dvec2 b) {
    const glm::dvec2 d = b - a;
    const double square = glm::dot(d, d);
    const double t = square > 0 ? std::clamp(glm::dot(p - a, d) / square, 0.0, 1.0) : 0;
    return glm::distance(p, a + t * d);
}

std::map<std::pair<double, double>, size_t> degrees(const std::vector<Polyline>& lines) {
    std::map<std::pair<double, double>, size_t> degree;
    for (const Polyline& line : lines)
        for (const glm::dvec2 end : {line.front(), line.back()}) ++degree[{end.x, end.y}];
    return degree;
}

/// How far `p` is beyond the square end `end` of a segment that comes from `from`.
double beyond(glm::dvec2 p, glm::dvec2 from, glm::dvec2 end) {
    return glm::dot(p - end, glm::normalize(end - from));
}

/// With round ends, or square ones: those stop at the ends instead of half a width beyond.
void paint(std::vector<uint8_t>& texels, const Drawing& drawing, const Brush& brush, glm::dvec2 a,
           glm::dvec2 b, bool squareA, bool squareB) {
    const double reach = brush.width / 2 + 2;
    const int x0 = std::max(0, static_cast<int>(std::floor(std::min(a.x, b.x) - reach)));
    const int x1 = std::min(drawing.width - 1, static_cast<int>(std::max(a.x, b.x) + reach));
    const int y0 = std::max(0, static_cast<int>(std::floor(std::min(a.y, b.y) - reach)));
    const int y1 = std::min(drawing.height - 1, static_cast<int>(std::max(a.y, b.y) + reach));
    for (int y = y0; y <= y1; ++y)
        for (int x = x0; x <= x1; ++x) {
            const glm::dvec2 p(x + 0.5, y + 0.5);
            double in = brush.width / 2 - distance(p, a, b);
            if (squareA) in = std::min(in, -beyond(p, b, a));
            if (squareB) in = std::min(in, -beyond(p, a, b));
            const double covered =
                brush.antialiased ? std::clamp(in + 0.5, 0.0, 1.0) : (in >= -1e-9 ? 1.0 : 0.0);
            uint8_t& texel = texels[static_cast<size_t>(y) * drawing.width + x];
            texel = std::max(texel, static_cast<uint8_t>(std::lround(255 * covered)));
        }
}

double normal(Random& random) {
    double sum = -6;
    for (int i = 0; i < 12; ++i) sum += random.unit();
    return sum;
}

}  // namespace

std::vector<uint8_t> coverage(const Drawing& drawing, const Brush& brush) {
    std::vector<uint8_t> texels(static_cast<size_t>(drawing.width) * drawing.height, 0);
    auto degree = degrees(drawing.lines);
    const auto isSquare = [&](glm::dvec2 end) {
        return brush.square && degree[{end.x, end.y}] == 1;
    };
    for (const Polyline& line : drawing.lines)
        for (size_t i = 1; i < line.size(); ++i)
            paint(texels, drawing, brush, line[i - 1], line[i], i == 1 && isSquare(line.front()),
                  i + 1 == line.size() && isSquare(line.back()));
    return texels;
}

std::vector<uint8_t> shades(const std::vector<uint8_t>& coverage, int ground, int ink, double sigma,
                            Random& random) {
    std::vector<uint8_t> grey(coverage.size());
    for (size_t i = 0; i < grey.size(); ++i) {
        double value = ground + (ink - ground) * coverage[i] / 255.0;
        if (sigma > 0) value += sigma * normal(random);
        grey[i] = static_cast<uint8_t>(std::lround(std::clamp(value, 0.0, 255.0)));
    }
    return grey;
}

std::vector<uint8_t> greyPng(const Drawing& drawing, const std::vector<uint8_t>& grey) {
    return pngBytes({static_cast<uint32_t>(drawing.width),
                     static_cast<uint32_t>(drawing.height),
                     8,
                     0,
                     grey,
                     {}});
}

std::vector<uint8_t> greyJpeg(const Drawing& drawing, const std::vector<uint8_t>& grey,
                              int quality) {
    std::vector<uint8_t> bytes;
    stbi_write_jpg_to_func(
        [](void* out, void* data, int size) {
            const auto* from = static_cast<const uint8_t*>(data);
            auto* to = static_cast<std::vector<uint8_t>*>(out);
            to->insert(to->end(), from, from + size);
        },
        &bytes, drawing.width, drawing.height, 1, grey.data(), quality);
    return bytes;
}

std::vector<uint8_t> plainPng(const Drawing& drawing, const Brush& brush) {
    Random random(0);
    return greyPng(drawing, shades(coverage(drawing, brush), 255, 0, 0, random));
}

std::vector<Polyline> inTexels(const FractureMap& map, const Drawing& drawing) {
    std::vector<Polyline> result;
    for (const FractureMap::Line& line : map.lines) {
        Polyline& points = result.emplace_back();
        for (const glm::dvec2 p : line.points)
            points.push_back(p * glm::dvec2(drawing.width, drawing.height));
    }
    return result;
}

GraphCounts countGraph(const std::vector<Polyline>& lines) {
    // E - V is that of the graph without its nodes of degree 2, but for a ring of nothing else.
    std::map<std::pair<double, double>, size_t> nodeOf;
    std::vector<size_t> parent;
    const auto root = [&](size_t i) {
        while (parent[i] != i) i = parent[i] = parent[parent[i]];
        return i;
    };
    const auto degree = degrees(lines);
    for (const auto& [point, count] : degree) {
        nodeOf[point] = parent.size();
        parent.push_back(parent.size());
    }
    for (const Polyline& line : lines)
        parent[root(nodeOf[{line.front().x, line.front().y}])] =
            root(nodeOf[{line.back().x, line.back().y}]);
    std::map<size_t, bool> isRing;
    size_t joins = 0;
    GraphCounts counts;
    for (const auto& [point, count] : degree) {
        isRing.emplace(root(nodeOf[point]), true);
        if (count == 2) {
            ++joins;
            continue;
        }
        isRing[root(nodeOf[point])] = false;
        ++counts.nodes;
        counts.loose += count == 1 ? 1 : 0;
    }
    counts.edges = lines.size() - joins;
    for (const auto& [component, ring] : isRing) counts.edges += ring ? 1 : 0;
    return counts;
}

double furthest(const std::vector<Polyline>& from, const std::vector<Polyline>& to) {
    double worst = 0;
    for (const Polyline& line : from)
        for (size_t i = 1; i < line.size(); ++i) {
            const int steps =
                std::max(1, static_cast<int>(4 * glm::distance(line[i - 1], line[i])));
            for (int s = 0; s <= steps; ++s) {
                const glm::dvec2 p = line[i - 1] + (line[i] - line[i - 1]) * (double(s) / steps);
                double nearest = HUGE_VAL;
                for (const Polyline& other : to)
                    for (size_t k = 1; k < other.size() && nearest > 0; ++k)
                        nearest = std::min(nearest, distance(p, other[k - 1], other[k]));
                worst = std::max(worst, nearest);
            }
        }
    return worst;
}

double hausdorff(const std::vector<Polyline>& a, const std::vector<Polyline>& b) {
    return std::max(furthest(a, b), furthest(b, a));
}

namespace {

struct Edge {
    size_t a, b;
};

/// Far enough from all other nodes and edges, and not at a sharp angle to those it meets?
bool fits(const std::vector<glm::dvec2>& nodes, const std::vector<Edge>& edges, Edge edge,
          double apart) {
    const glm::dvec2 a = nodes[edge.a];
    const glm::dvec2 b = nodes[edge.b];
    for (size_t i = 0; i < nodes.size(); ++i)
        if (i != edge.a && i != edge.b && distance(nodes[i], a, b) < apart) return false;
    for (const Edge other : edges) {
        const glm::dvec2 c = nodes[other.a];
        const glm::dvec2 d = nodes[other.b];
        if (other.a == edge.a || other.a == edge.b || other.b == edge.a || other.b == edge.b) {
            const bool atA = other.a == edge.a || other.b == edge.a;
            const bool itsA = other.a == (atA ? edge.a : edge.b);
            const glm::dvec2 u = glm::normalize(atA ? b - a : a - b);
            const glm::dvec2 v = glm::normalize(itsA ? d - c : c - d);
            if (glm::dot(u, v) > std::cos(0.7)) return false;
            continue;
        }
        if (cross(b - a, c - a) * cross(b - a, d - a) < 0 &&
            cross(d - c, a - c) * cross(d - c, b - c) < 0)
            return false;
    }
    return true;
}

}  // namespace

Drawing randomDrawing(Random& random, double width) {
    const double cell = 24 + 6 * width;
    const auto columns = static_cast<int>(3 + random.below(3));
    const auto rows = static_cast<int>(3 + random.below(3));
    Drawing drawing{static_cast<int>(cell * columns), static_cast<int>(cell * rows), {}};
    std::vector<glm::dvec2> nodes;
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x)
            nodes.push_back(cell * glm::dvec2(x + random.in(0.3, 0.7), y + random.in(0.3, 0.7)));
    std::vector<Edge> edges;
    for (size_t i = 0; i < 12 * nodes.size(); ++i) {
        const Edge edge{random.below(static_cast<uint32_t>(nodes.size())),
                        random.below(static_cast<uint32_t>(nodes.size()))};
        if (edge.a == edge.b || glm::distance(nodes[edge.a], nodes[edge.b]) > 2.3 * cell) continue;
        if (!fits(nodes, edges, edge, 0.35 * cell)) continue;
        edges.push_back(edge);
        drawing.lines.push_back({nodes[edge.a], nodes[edge.b]});
    }
    return drawing;
}

}  // namespace sherd::test
