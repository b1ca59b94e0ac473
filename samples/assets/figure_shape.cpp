// SPDX-License-Identifier: MIT
#include "figure_shape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "signed_distance.h"
#include "texture.h"

namespace sherd::samples {
namespace {

/// The robed body is a stack of ellipses.
struct Section {
    double height;   ///< metres, as all below
    double sideX;    ///< half width
    double sideZ;    ///< half depth
    double middleX;  ///< the stance sways
    double middleZ;
};

constexpr std::array<Section, 10> kBody{{{0.130, 0.106, 0.086, 0.000, 0.004},
                                         {0.180, 0.102, 0.083, 0.000, 0.004},
                                         {0.300, 0.088, 0.072, 0.001, 0.003},
                                         {0.430, 0.083, 0.066, 0.004, 0.003},
                                         {0.560, 0.085, 0.064, 0.008, 0.000},
                                         {0.640, 0.076, 0.056, 0.006, 0.000},
                                         {0.700, 0.062, 0.046, 0.003, 0.002},
                                         {0.765, 0.073, 0.052, 0.000, 0.002},
                                         {0.815, 0.082, 0.044, 0.000, -0.003},
                                         {0.860, 0.062, 0.034, 0.000, -0.006}}};

/// Catmull-Rom between the sections.
Section sectionAt(double y) {
    const double clamped = std::clamp(y, kBody.front().height, kBody.back().height);
    size_t i = 0;
    while (i + 2 < kBody.size() && kBody[i + 1].height < clamped) ++i;
    const Section& a = kBody[i == 0 ? 0 : i - 1];
    const Section& b = kBody[i];
    const Section& c = kBody[i + 1];
    const Section& d = kBody[std::min(i + 2, kBody.size() - 1)];
    const double t = (clamped - b.height) / (c.height - b.height);
    const auto blend = [&](double Section::*member) {
        const double slopeB = (c.*member - a.*member) / (c.height - a.height);
        const double slopeC = (d.*member - b.*member) / (d.height - b.height);
        const double span = c.height - b.height;
        const double s = 1 - t;
        return b.*member * (s * s * (1 + 2 * t)) + slopeB * span * (s * s * t) +
               c.*member * (t * t * (3 - 2 * t)) - slopeC * span * (t * t * s);
    };
    return {clamped, blend(&Section::sideX), blend(&Section::sideZ), blend(&Section::middleX),
            blend(&Section::middleZ)};
}

/// Ridges of cloth between narrow valleys, -1 to 0, `count` of them around.
double folds(double angle, double count) {
    const double wave = std::sin(angle * count / 2);
    return (std::sqrt(wave * wave + 0.05) - 1.0247) / 0.801;
}

/// How far the cloth stands out at this height and angle (0: front).
double cloth(double y, double angle) {
    // Folds bunch and spread on their way around, and lean on their way down.
    const double bunched =
        angle + 0.13 * std::sin(2 * angle + 5 * y) + 0.05 * std::sin(5 * angle + 1);
    const double hanging = 1 - smoothStep(0.30, 0.62, y);
    double out = 0.0155 * hanging * folds(bunched + 0.25 * std::sin(5 * y + 1), 11);
    // The overfold hangs from the shoulders over the girdle and ends in a wavy hem.
    const double hem = 0.572 + 0.011 * std::sin(4 * angle + 0.6) + 0.005 * std::sin(7 * angle);
    const double over = smoothStep(hem - 0.009, hem + 0.007, y);
    const double swing = 1 - smoothStep(0.60, 0.70, y);
    out += over * (0.009 + 0.005 * swing + 0.009 * folds(bunched + 0.4, 11) * (0.4 + 0.6 * swing));
    const double girdle = (y - 0.693) / 0.011;
    out -= 0.007 * std::exp(-girdle * girdle);
    return out;
}

double body(const glm::dvec3& p) {
    const Section s = sectionAt(p.y);
    const glm::dvec2 q((p.x - s.middleX) / s.sideX, (p.z - s.middleZ) / s.sideZ);
    const double k = glm::length(q);
    const double slope = glm::length(glm::dvec2(q.x / s.sideX, q.y / s.sideZ));
    const double round = slope < 1e-9 ? -s.sideZ : k * (k - 1) / slope;
    const double draped = round - cloth(p.y, std::atan2(q.x, q.y)) * std::min(1.0, k);
    return blendCommon(draped, std::max(p.y - 0.858, 0.10 - p.y), 0.03);
}

double legsAndFeet(const glm::dvec3& p) {
    // Her weight rests on one leg; the other knee shows through the cloth.
    const double thigh = limb(p, {-0.036, 0.58, 0.005}, {-0.046, 0.385, 0.052}, 0.046, 0.036);
    const double shin = limb(p, {-0.046, 0.385, 0.052}, {-0.050, 0.20, 0.046}, 0.034, 0.024);
    const double leg = blendUnion(thigh, shin, 0.02);
    const double left = limb(p, {-0.046, 0.160, 0.060}, {-0.058, 0.158, 0.118}, 0.021, 0.016);
    const double right = limb(p, {0.040, 0.160, 0.050}, {0.048, 0.158, 0.104}, 0.021, 0.016);
    return blendUnion(leg, std::min(left, right), 0.012);
}

double bust(const glm::dvec3& p) {
    const double left = ellipsoid(p, {-0.033, 0.778, 0.040}, {0.030, 0.030, 0.024});
    const double right = ellipsoid(p, {0.033, 0.778, 0.040}, {0.030, 0.030, 0.024});
    const double shoulders = limb(p, {-0.078, 0.838, -0.006}, {0.078, 0.838, -0.006}, 0.026, 0.026);
    return blendUnion(std::min(left, right), shoulders, 0.02);
}

/// One hangs beside the body and gathers the robe, one holds an apple before it.
double arms(const glm::dvec3& p) {
    const glm::dvec3 shoulderL(-0.090, 0.832, -0.006);
    const glm::dvec3 elbowL(-0.126, 0.690, -0.022);
    const glm::dvec3 wristL(-0.122, 0.568, 0.018);
    double hanging = blendUnion(limb(p, shoulderL, elbowL, 0.028, 0.0225),
                                limb(p, elbowL, wristL, 0.0225, 0.0160), 0.03);
    hanging = blendUnion(hanging, limb(p, wristL, {-0.113, 0.524, 0.034}, 0.0165, 0.0155), 0.02);
    const glm::dvec3 shoulderR(0.090, 0.832, -0.006);
    const glm::dvec3 elbowR(0.128, 0.702, 0.004);
    const glm::dvec3 wristR(0.078, 0.728, 0.118);
    double holding = blendUnion(limb(p, shoulderR, elbowR, 0.028, 0.0235),
                                limb(p, elbowR, wristR, 0.0235, 0.0165), 0.03);
    holding = blendUnion(holding, limb(p, wristR, {0.064, 0.737, 0.138}, 0.017, 0.018), 0.012);
    const double apple = glm::distance(p, {0.056, 0.760, 0.143}) - 0.024;
    return std::min(hanging, blendUnion(holding, apple, 0.008));
}

constexpr glm::dvec3 kSkull{0.0, 0.944, 0.002};

double hairShape(const glm::dvec3& p) {
    // Combed back in waves from a parting, and knotted behind.
    const glm::dvec3 q = p - kSkull;
    const double wave = 0.0022 * std::sin(260 * (q.y + 0.55 * std::abs(q.x) - 0.5 * q.z));
    double cap =
        ellipsoid(p, kSkull + glm::dvec3(0, 0.006, -0.006), {0.0475, 0.053, 0.0555}) + wave;
    // The hairline: back from the brow, down before the ears.
    const double line = 0.010 + 1.35 * q.y;
    cap = blendCommon(cap, (q.z - line) * 0.6, 0.006);
    const double knot = ellipsoid(p, {0, 0.925, -0.062}, {0.024, 0.022, 0.022}) + wave;
    return blendUnion(cap, knot, 0.010);
}

double face(const glm::dvec3& p) {
    const glm::dvec3 mirrored(std::abs(p.x), p.y, p.z);
    double head = ellipsoid(p, kSkull, {0.0415, 0.049, 0.050});
    head = blendUnion(head, ellipsoid(p, {0, 0.917, 0.020}, {0.0305, 0.034, 0.031}), 0.022);
    head = blendUnion(head, ellipsoid(p, {0, 0.891, 0.036}, {0.011, 0.009, 0.010}), 0.014);
    // Sockets first, then lids in them.
    head = blendCut(head, ellipsoid(mirrored, {0.0165, 0.9365, 0.0535}, {0.0120, 0.0075, 0.0085}),
                    0.007);
    head = blendUnion(head, ellipsoid(mirrored, {0.0165, 0.9360, 0.0415}, {0.0085, 0.0058, 0.0070}),
                      0.002);
    head =
        blendUnion(head, limb(p, {0, 0.940, 0.0475}, {0, 0.9195, 0.0565}, 0.0042, 0.0062), 0.006);
    head = blendUnion(head, ellipsoid(p, {0, 0.9075, 0.0490}, {0.0100, 0.0034, 0.0052}), 0.003);
    head = blendUnion(head, ellipsoid(p, {0, 0.9015, 0.0475}, {0.0080, 0.0034, 0.0050}), 0.003);
    return head;
}

double headAndNeck(const glm::dvec3& p) {
    const double neck = limb(p, {0, 0.845, -0.008}, {0, 0.905, 0.000}, 0.031, 0.0265);
    return blendUnion(blendUnion(neck, face(p), 0.012), hairShape(p), 0.004);
}

double plinth(const glm::dvec3& p) {
    double out = roundBox(p, {0, 0.0225, 0.01}, {0.150, 0.0225, 0.140}, 0.010);
    out = blendUnion(out, roundBox(p, {0, 0.075, 0.01}, {0.128, 0.060, 0.118}, 0.010), 0.012);
    return blendUnion(out, roundBox(p, {0, 0.135, 0.01}, {0.142, 0.015, 0.132}, 0.010), 0.012);
}

constexpr double kHeadScale = 1.12;

/// The head is turned and inclined a little.
glm::dvec3 toHead(const glm::dvec3& p) {
    constexpr glm::dvec3 kPivot{0, 0.868, -0.004};
    constexpr double kTurn = 0.24;
    constexpr double kTilt = 0.07;
    const glm::dvec3 q = (p - kPivot) / kHeadScale;
    const glm::dvec3 turned(q.x * std::cos(kTurn) - q.z * std::sin(kTurn), q.y,
                            q.x * std::sin(kTurn) + q.z * std::cos(kTurn));
    return kPivot + glm::dvec3(turned.x * std::cos(kTilt) + turned.y * std::sin(kTilt),
                               turned.y * std::cos(kTilt) - turned.x * std::sin(kTilt), turned.z);
}

}  // namespace

double figureShape(const glm::dvec3& p) {
    double out = blendUnion(body(p), legsAndFeet(p), 0.03);
    out = blendUnion(out, bust(p), 0.022);
    out = blendUnion(out, arms(p), 0.012);
    out = blendUnion(out, headAndNeck(toHead(p)) * kHeadScale, 0.014);
    return blendUnion(out, plinth(p), 0.008);
}

double figureHair(const glm::dvec3& p) {
    const glm::dvec3 q = toHead(p);
    return 1 - smoothStep(0.0, 0.003, hairShape(q) - face(q));
}

}  // namespace sherd::samples
