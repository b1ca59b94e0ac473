// SPDX-License-Identifier: MIT
// A terracotta vase in the manner of a Greek amphora without handles.
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

constexpr double kTurn = 2 * std::numbers::pi;

const glm::dvec3 kClay(0.76, 0.41, 0.22);
const glm::dvec3 kGlaze(0.085, 0.07, 0.075);
const glm::dvec3 kCream(0.90, 0.80, 0.62);
const glm::dvec3 kInside(0.62, 0.33, 0.19);

struct VaseShape {
    std::vector<ProfilePoint> profile;
    uint32_t foot = 0;    ///< ring where the bottom disc ends
    uint32_t lip = 0;     ///< ring where the inner skin begins
    uint32_t bottom = 0;  ///< ring where the inner bottom begins
};

void append(std::vector<ProfilePoint>& profile, std::span<const ProfilePoint> points,
            uint32_t steps) {
    const std::vector<ProfilePoint> curve = smoothProfile(points, steps);
    profile.insert(profile.end(), curve.begin() + (profile.empty() ? 0 : 1), curve.end());
}

VaseShape vaseShape() {
    const std::array<ProfilePoint, 4> base{
        {{0, 0.004}, {0.022, 0.004}, {0.042, 0.003}, {0.054, 0}}};
    const std::array<ProfilePoint, 14> outside{{{0.054, 0},
                                                {0.058, 0.005},
                                                {0.055, 0.014},
                                                {0.047, 0.023},
                                                {0.052, 0.038},
                                                {0.078, 0.085},
                                                {0.102, 0.140},
                                                {0.113, 0.192},
                                                {0.104, 0.240},
                                                {0.074, 0.280},
                                                {0.054, 0.303},
                                                {0.050, 0.322},
                                                {0.058, 0.342},
                                                {0.074, 0.354}}};
    const std::array<ProfilePoint, 4> lip{
        {{0.074, 0.354}, {0.0765, 0.358}, {0.0735, 0.3615}, {0.068, 0.360}}};
    const std::array<ProfilePoint, 10> inside{{{0.068, 0.360},
                                               {0.048, 0.342},
                                               {0.040, 0.322},
                                               {0.044, 0.299},
                                               {0.064, 0.274},
                                               {0.094, 0.235},
                                               {0.102, 0.192},
                                               {0.091, 0.145},
                                               {0.066, 0.092},
                                               {0.036, 0.048}}};
    const std::array<ProfilePoint, 3> bottom{{{0.036, 0.048}, {0.020, 0.038}, {0, 0.035}}};
    VaseShape shape;
    append(shape.profile, base, 1);
    shape.foot = static_cast<uint32_t>(shape.profile.size() - 1);
    append(shape.profile, outside, 2);
    append(shape.profile, lip, 1);
    shape.lip = static_cast<uint32_t>(shape.profile.size() - 1);
    append(shape.profile, inside, 2);
    shape.bottom = static_cast<uint32_t>(shape.profile.size() - 1);
    append(shape.profile, bottom, 1);
    return shape;
}

Mesh vaseMesh() {
    VaseShape shape = vaseShape();
    Lathe lathe;
    lathe.segments = 72;
    using Kind = LatheChart::Kind;
    const auto last = static_cast<uint32_t>(shape.profile.size() - 1);
    lathe.charts = {
        {Kind::disc, 0, shape.foot, {0.86, 0.14}, {2.2, 2.2}},
        {Kind::strip, shape.foot, shape.lip, {0.015, 0.985}, {0.71, 0.30}},
        // Seen from within, the angle runs the other way.
        {Kind::strip, shape.lip, shape.bottom, {0.71, 0.015}, {0.015, 0.285}},
        {Kind::disc, shape.bottom, last, {0.86, 0.42}, {2.6, -2.6}},
    };
    lathe.profile = std::move(shape.profile);
    Mesh mesh = turn(lathe);
    computeNormals(mesh, 50);
    return mesh;
}

/// One period of a meander: 1 on the line, 0 beside it. x in periods, y 0 to 1 over the band.
double meander(double x, double y) {
    static constexpr std::array<const char*, 7> kCells{
        "########", "#......#", "#.####.#", "#.#..#.#", "#.##.#.#", "#....#.#", "######.#"};
    const double column = (x - std::floor(x)) * 8;
    const double row = std::clamp((1 - y) * 7, 0.0, 6.999);
    return kCells[static_cast<size_t>(row)][std::min<size_t>(7, static_cast<size_t>(column))] == '#'
               ? 1
               : 0;
}

/// Triangular rays rising from the foot.
double rays(double x, double y) {
    const double across = std::abs(x - std::floor(x) - 0.5) * 2;
    return 1 - smoothStep(0.80 * (1 - y), 0.80 * (1 - y) + 0.06, across);
}

/// A wave of running spirals, drawn as the crest line and a dot in each trough.
double wave(double x, double y) {
    const double crest = 0.5 + 0.33 * std::sin(kTurn * x);
    const double line = stripe(y - crest, 0.10, 0.03);
    const double dx = x - std::floor(x);
    const double low = std::hypot((dx - 0.75) * 2.4, y - 0.62);
    const double high = std::hypot((dx - 0.25) * 2.4, y - 0.38);
    return std::max(line, 1 - smoothStep(0.13, 0.17, std::min(low, high)));
}

/// A stem that swings around the belly, with a leaf in each bow.
double leaves(double x, double y) {
    const double dy = y - 0.5;
    const double swing = 0.13 * std::sin(kTurn * x);
    double ink = stripe(dy - swing, 0.022, 0.02);
    for (const double side : {-1.0, 1.0}) {
        // A leaf is where two discs meet, leaning along the stem.
        const double dx = x - 0.25 * side - std::round(x - 0.25 * side);
        const double ly = dy + side * 0.16;
        const double lx = dx * 0.62 + ly * 0.45 * side;
        const double lens = std::max(std::hypot(lx - 0.16, ly), std::hypot(lx + 0.16, ly));
        const double leaf = 1 - smoothStep(0.272, 0.285, lens);
        const double rib = stripe(lx, 0.008, 0.010) * stripe(ly, 0.15, 0.04);
        ink = std::max(ink, leaf * (1 - rib));
    }
    return ink;
}

struct Band {
    double low, high;  ///< metres
    double within(double y) const { return (y - low) / (high - low); }
    bool holds(double y) const { return y >= low && y < high; }
};

/// Share of glaze on the outside at height y, turns around the axis x.
double glaze(double x, double y) {
    constexpr Band kFoot{-1, 0.034};
    constexpr Band kRays{0.034, 0.088};
    constexpr Band kLower{0.100, 0.122};
    constexpr Band kBelly{0.136, 0.196};
    constexpr Band kMeander{0.209, 0.236};
    constexpr Band kShoulder{0.252, 0.268};
    constexpr Band kNeck{0.276, 0.334};
    if (kFoot.holds(y)) return 1 - stripe(y - 0.024, 0.0012, 0.0006);
    if (kRays.holds(y)) return rays(x * 22, kRays.within(y));
    double ink = 0;
    if (kLower.holds(y)) ink = wave(x * 16, kLower.within(y));
    if (kBelly.holds(y)) ink = leaves(x * 10, kBelly.within(y));
    if (kMeander.holds(y)) ink = meander(x * 18, kMeander.within(y));
    if (kShoulder.holds(y)) ink = rays(x * 48, kShoulder.within(y));
    if (kNeck.holds(y) || y > 0.340) ink = 1;
    for (const double ring : {0.093, 0.127, 0.203, 0.241, 0.272})
        ink = std::max(ink, stripe(y - ring, 0.0016, 0.0006));
    for (const double ring : {0.0975, 0.1315, 0.1995, 0.2455})
        ink = std::max(ink, stripe(y - ring, 0.0006, 0.0005));
    return ink;
}

glm::dvec3 paintVase(const SurfacePoint& point) {
    const glm::dvec3& p = point.position;
    const double radius = std::hypot(p.x, p.z);
    const double x = std::atan2(-p.z, p.x) / kTurn + 0.5;
    const bool inside = point.uv.y < 0.292 || point.uv.x > 0.72;
    const double grain = fractalNoise(p * 90.0, 4, 11);
    const double turned = gradientNoise({p.x * 12, p.y * 420, p.z * 12}, 5);
    const glm::dvec3 clay = kClay * (1 + 0.13 * grain + 0.05 * turned);
    if (inside && !(point.uv.x < 0.72 && p.y > 0.345)) {
        const double under = radius < 0.06 && p.y < 0.02 ? 1.08 : 1;
        return kInside * under * (1 + 0.16 * grain + 0.07 * turned);
    }
    // A brush does not lay glaze evenly: its rim wavers and its body is streaky.
    const double waver = 0.0006 * gradientNoise(p * 260.0, 21);
    const double ink = inside ? 1 : glaze(x + waver * 2, p.y + waver);
    const glm::dvec3 dark = kGlaze * (1 + 0.30 * turned + 0.35 * grain);
    const glm::dvec3 ground =
        glm::mix(clay, kCream * (1 + 0.08 * grain), stripe(p.y - 0.166, 0.0345, 0.001));
    return glm::mix(ground, dark, ink * 0.97);
}

CrackPattern vaseCracks(const Mesh& mesh) {
    CrackPattern pattern;
    pattern.options = {{1, 0.85, 1}, 0.034, 0.075, 5, 4, 9};
    pattern.level1 = {{{0.085, 0.270, 0.035}, 0},   {{-0.020, 0.275, 0.085}, 0},
                      {{-0.075, 0.260, -0.055}, 0}, {{0.030, 0.285, -0.070}, 0},
                      {{0.065, 0.090, -0.025}, 0},  {{-0.060, 0.100, 0.035}, 0}};
    const ScatterOptions scatter{{4, 3, 3, 3, 4, 3}, {0.11, 0.2, 0.0}, 0.005, 1};
    pattern.level2 = scatterSites(mesh, pattern, scatter);
    return pattern;
}

}  // namespace

SampleObject makeVase() {
    SampleObject vase;
    vase.name = "vase";
    vase.mesh = vaseMesh();
    vase.texture = paintTexture(vase.mesh, kSampleTexture, paintVase);
    vase.roughness = 0.45;
    vase.stuff = {{0.48, 0.20, 0.095}, 1900};
    vase.cracks = vaseCracks(vase.mesh);
    return vase;
}

}  // namespace sherd::samples
