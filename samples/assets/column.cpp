// SPDX-License-Identifier: MIT
// A fluted marble column on a square plinth, with a Doric capital.
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <numbers>

#include "lathe.h"
#include "noise.h"
#include "sample_object.h"

namespace sherd::samples {
namespace {

constexpr uint32_t kFlutes = 16;
constexpr double kFluteDepth = 0.011;
constexpr double kShaftLow = 0.135;
constexpr double kShaftHigh = 0.985;

enum class Outline { round, fluted, square };

struct ColumnRing {
    double radius;  ///< half the side, for a square
    double height;
    Outline section;
};

/// Tapering, with a slight swelling (entasis).
double shaftRadius(double y) {
    const double t = (y - kShaftLow) / (kShaftHigh - kShaftLow);
    return 0.128 - 0.026 * t + 0.005 * std::sin(std::numbers::pi * t);
}

std::vector<ColumnRing> columnRings() {
    using enum Outline;
    std::vector<ColumnRing> rings{
        {0, 0, square},         {0.085, 0, square},     {0.166, 0, square},
        {0.172, 0.006, square}, {0.172, 0.038, square}, {0.172, 0.064, square},
        {0.166, 0.070, square}, {0.148, 0.070, round},  {0.157, 0.079, round},
        {0.160, 0.090, round},  {0.157, 0.101, round},  {0.147, 0.109, round},
        {0.138, 0.112, round},  {0.138, 0.120, round}};
    constexpr uint32_t kShaftRings = 21;
    for (uint32_t i = 0; i <= kShaftRings; ++i) {
        const double t = double(i) / kShaftRings;
        // Rings lie closer near the ends, where the flutes run out.
        const double eased = t + 0.085 * -std::sin(2 * std::numbers::pi * t);
        const double y = kShaftLow + (kShaftHigh - kShaftLow) * eased;
        rings.push_back({shaftRadius(y), y, fluted});
    }
    const std::array<ColumnRing, 17> capital{{{0.108, 0.998, round},
                                              {0.115, 1.004, round},
                                              {0.115, 1.012, round},
                                              {0.108, 1.018, round},
                                              {0.112, 1.032, round},
                                              {0.114, 1.048, round},
                                              {0.126, 1.066, round},
                                              {0.146, 1.086, round},
                                              {0.160, 1.104, round},
                                              {0.163, 1.116, round},
                                              {0.158, 1.124, round},
                                              {0.166, 1.126, square},
                                              {0.172, 1.132, square},
                                              {0.172, 1.164, square},
                                              {0.172, 1.194, square},
                                              {0.166, 1.200, square},
                                              {0.085, 1.200, square}}};
    rings.insert(rings.end(), capital.begin(), capital.end());
    rings.push_back({0, 1.200, square});
    return rings;
}

/// How deep the flutes are at height y: they run out towards both ends of the shaft.
double fluteDepth(double y) {
    return kFluteDepth * smoothStep(kShaftLow, kShaftLow + 0.035, y) *
           (1 - smoothStep(kShaftHigh - 0.035, kShaftHigh, y));
}

double sectionRadius(const ColumnRing& ring, double angle) {
    switch (ring.section) {
        case Outline::square:
            return ring.radius / std::max(std::abs(std::cos(angle)), std::abs(std::sin(angle)));
        case Outline::fluted: {
            const double phase = angle * kFlutes / (2 * std::numbers::pi);
            const double across = (phase - std::floor(phase)) * 2 - 1;
            return ring.radius -
                   fluteDepth(ring.height) * std::sqrt(std::max(0.0, 1 - across * across));
        }
        case Outline::round:
            break;
    }
    return ring.radius;
}

Mesh columnMesh() {
    const std::vector<ColumnRing> rings = columnRings();
    Lathe lathe;
    lathe.segments = 6 * kFlutes;
    for (const ColumnRing& ring : rings) lathe.profile.push_back({ring.radius, ring.height});
    lathe.radius = [&rings](uint32_t ring, double angle) {
        return sectionRadius(rings[ring], angle);
    };
    const auto last = static_cast<uint32_t>(rings.size() - 1);
    using Kind = LatheChart::Kind;
    lathe.charts = {
        {Kind::disc, 0, 2, {0.85, 0.83}, {0.78, 0.78}},
        {Kind::strip, 2, last - 2, {0.012, 0.988}, {0.69, 0.012}},
        {Kind::disc, last - 2, last, {0.85, 0.53}, {0.78, -0.78}},
    };
    Mesh mesh = turn(lathe);
    computeNormals(mesh, 38);
    return mesh;
}

/// Veins where a bent noise crosses zero: thin, branching, of uneven strength.
double vein(const glm::dvec3& p, double size, double width, uint32_t seed) {
    const glm::dvec3 bent = p / size + 0.55 * fractalNoise3(p / (size * 1.3), 4, seed + 50);
    const double ridge = std::abs(fractalNoise(bent, 3, seed));
    return std::exp(-ridge / width);
}

glm::dvec3 paintColumn(const SurfacePoint& point) {
    const glm::dvec3& p = point.position;
    const glm::dvec3 slanted(p.x + 0.35 * p.y, p.y * 0.62, p.z - 0.25 * p.y);
    const double cloud = fractalNoise(slanted * 7.0, 5, 3);
    const double grain = fractalNoise(p * 160.0, 2, 4);
    glm::dvec3 color = glm::mix(glm::dvec3(0.93, 0.915, 0.885), glm::dvec3(0.80, 0.79, 0.785),
                                smoothStep(-0.25, 0.45, cloud));
    const double strength = smoothStep(-0.35, 0.4, fractalNoise(slanted * 4.0, 3, 8));
    color = glm::mix(color, glm::dvec3(0.40, 0.42, 0.46),
                     0.80 * strength * vein(slanted, 0.26, 0.030, 31));
    color = glm::mix(color, glm::dvec3(0.62, 0.54, 0.44),
                     0.35 * strength * vein(slanted, 0.30, 0.016, 77));
    // Dust settles in the flutes and under the mouldings.
    const double radius = std::hypot(p.x, p.z);
    const bool shaft = p.y > kShaftLow && p.y < kShaftHigh;
    const double hollow = shaft ? smoothStep(0.0, kFluteDepth, shaftRadius(p.y) - radius) : 0.0;
    const double under = smoothStep(0.1, 0.9, -point.normal.y);
    return color * (1 + 0.035 * grain) * (1 - 0.13 * hollow) * (1 - 0.10 * under);
}

CrackPattern columnCracks(const Mesh& mesh) {
    CrackPattern pattern;
    pattern.options = {{0.75, 1, 0.75}, 0.065, 0.17, 6, 4, 6};
    pattern.level1 = {{{0.01, 0.08, 0.02}, 0}, {{0.07, 0.33, -0.02}, 0}, {{-0.07, 0.40, 0.03}, 0},
                      {{0.01, 0.60, 0.04}, 0}, {{0.05, 0.80, -0.04}, 0}, {{-0.05, 0.87, 0.03}, 0},
                      {{0.00, 1.11, 0.00}, 0}};
    pattern.level2 =
        scatterSites(mesh, pattern, {{4, 4, 4, 5, 3, 4, 5}, {0.12, 0.62, 0.0}, 0.05, 2});
    return pattern;
}

}  // namespace

SampleObject makeColumn() {
    SampleObject column;
    column.name = "column";
    column.mesh = columnMesh();
    column.texture = paintTexture(column.mesh, kSampleTexture, paintColumn);
    column.roughness = 0.55;
    column.stuff = {{0.62, 0.61, 0.59}, 2700};
    column.cracks = columnCracks(column.mesh);
    return column;
}

}  // namespace sherd::samples
