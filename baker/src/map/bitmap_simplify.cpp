// SPDX-License-Identifier: MIT
// D. H. Douglas, T. K. Peucker, "Algorithms for the Reduction of the Number of Points Required to
// Represent a Digitized Line or its Caricature", Cartographica 10(2), 1973; with a stack of its own
// instead of recursion.
#include "map/bitmap_simplify.h"

#include <algorithm>
#include <cstddef>
#include <glm/geometric.hpp>
#include <utility>

namespace sherd {

namespace {

// A spiral splits at its outer turns first, which takes the square of its points.
constexpr size_t kMostAtOnce = 4096;

double distanceToSegment(glm::dvec2 p, glm::dvec2 a, glm::dvec2 b) {
    const glm::dvec2 d = b - a;
    const double square = glm::dot(d, d);
    const double t = square > 0 ? std::clamp(glm::dot(p - a, d) / square, 0.0, 1.0) : 0;
    return glm::distance(p, a + t * d);
}

struct Furthest {
    size_t at = 0;
    double distance = -1;
};

/// Among the points between `first` and `last`, from the segment between these two.
Furthest furthest(std::span<const glm::dvec2> points, size_t first, size_t last) {
    Furthest result;
    for (size_t i = first + 1; i < last; ++i) {
        const double distance = distanceToSegment(points[i], points[first], points[last]);
        if (distance > result.distance) result = {i, distance};
    }
    return result;
}

}  // namespace

std::vector<glm::dvec2> simplify(std::span<const glm::dvec2> points, double tolerance) {
    if (points.size() < 3) return {points.begin(), points.end()};
    std::vector<char> kept(points.size(), 0);
    kept.front() = kept.back() = 1;
    std::vector<std::pair<size_t, size_t>> open;
    for (size_t first = 0; first + 1 < points.size(); first += kMostAtOnce) {
        open.emplace_back(first, std::min(first + kMostAtOnce, points.size() - 1));
        kept[first] = 1;
    }
    if (open.size() == 1 && points.front() == points.back()) {
        // The two points of a closed line furthest apart as seen from its start, and one aside.
        const size_t far = furthest(points, 0, points.size() - 1).at;
        const Furthest one = furthest(points, 0, far);
        const Furthest other = furthest(points, far, points.size() - 1);
        const size_t aside = one.distance >= other.distance ? one.at : other.at;
        kept[far] = kept[aside] = 1;
        open = {{0, std::min(far, aside)},
                {std::min(far, aside), std::max(far, aside)},
                {std::max(far, aside), points.size() - 1}};
    }
    while (!open.empty()) {
        const auto [first, last] = open.back();
        open.pop_back();
        const Furthest worst = furthest(points, first, last);
        if (worst.distance <= tolerance) continue;
        kept[worst.at] = 1;
        open.emplace_back(first, worst.at);
        open.emplace_back(worst.at, last);
    }
    std::vector<glm::dvec2> result;
    for (size_t i = 0; i < points.size(); ++i)
        if (kept[i] != 0) result.push_back(points[i]);
    return result;
}

}  // namespace sherd
