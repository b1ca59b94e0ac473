// SPDX-License-Identifier: MIT
#include "appearance/rough_field.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <random>

namespace sherd {
namespace {

constexpr double kJitter = 0.35;        ///< of a plane in its stretch, in stretches, either way
constexpr double kSecondSpacing = 0.6;  ///< of a layer's second three folds, in spacings

/// A direction by chance; by rejection, so that it needs no function that differs between systems.
glm::dvec3 direction(std::mt19937& random) {
    while (true) {
        glm::dvec3 v;
        for (int c = 0; c < 3; ++c) v[c] = 2 * (random() / 4294967296.0) - 1;
        const double length2 = glm::dot(v, v);
        if (length2 > 1e-2 && length2 <= 1) return v / std::sqrt(length2);
    }
}

std::array<glm::dvec3, 3> axes(std::mt19937& random) {
    const glm::dvec3 first = direction(random);
    glm::dvec3 second = first;
    while (std::abs(glm::dot(first, second)) > 0.9) second = direction(random);
    second = glm::normalize(second - first * glm::dot(first, second));
    return {first, second, glm::cross(first, second)};
}

/// From 0 to 1 (Steele, Lea and Flood, Fast Splittable Pseudorandom Number Generators, 2014).
double chance(uint64_t seed, int64_t n) {
    uint64_t z = seed + static_cast<uint64_t>(n) * 0x9E3779B97F4A7C15ULL;
    z = (z ^ z >> 30) * 0xBF58476D1CE4E5B9ULL;
    z = (z ^ z >> 27) * 0x94D049BB133111EBULL;
    return static_cast<double>((z ^ z >> 31) >> 11) / 9007199254740992.0;
}

}  // namespace

RoughField::RoughField(double bumpSize, uint32_t seed) {
    std::mt19937 random(seed);
    double spacing = bumpSize;
    double strength = 0.6;
    double reach = 0;
    for (Layer& layer : layers_) {
        layer.strength = strength;
        for (size_t f = 0; f < 6; f += 3) {
            const std::array<glm::dvec3, 3> frame = axes(random);
            for (size_t k = 0; k < 3; ++k) {
                const uint64_t high = random();
                layer.folds[f + k] = {frame[k], f == 0 ? spacing : kSecondSpacing * spacing,
                                      high << 32 | random()};
            }
        }
        reach += strength * layer.extent() * std::sqrt(3.0) / 2;
        spacing /= 2;
        strength = 1 - strength;
    }
    // Both layers together have slope 1 so far.
    steepest_ = 1 / reach;
    for (Layer& layer : layers_) layer.strength /= reach;
}

RoughField::Value RoughField::at(const glm::dvec3& p) const {
    Value sum;
    for (const Layer& layer : layers_) {
        const Value value = layer.at(p);
        sum.vector += layer.strength * value.vector;
        sum.slope += layer.strength * value.slope;
    }
    return sum;
}

double RoughField::Fold::planeIn(double stretch) const {
    // Beyond 2^53 stretches there are no places between; all planes there may be alike.
    const double bounded = std::clamp(stretch, -9e15, 9e15);
    const double jitter = kJitter * (2 * chance(seed, static_cast<int64_t>(bounded)) - 1);
    return (stretch + 0.5 + jitter) * spacing;
}

/// Brings a place to the near side of the nearest plane: its distance from there becomes its place.
void RoughField::Fold::fold(Value& value) const {
    const double t = glm::dot(value.vector, axis);
    const double stretch = std::floor(t / spacing);
    double nearest = std::numeric_limits<double>::max();
    for (const double other : {-1.0, 0.0, 1.0}) {
        const double distance = t - planeIn(stretch + other);
        if (std::abs(distance) < std::abs(nearest)) nearest = distance;
    }
    value.vector += axis * (std::abs(nearest) - t);
    if (nearest >= 0) return;
    for (int c = 0; c < 3; ++c) value.slope[c] -= axis * (2 * glm::dot(axis, value.slope[c]));
}

double RoughField::Layer::extent() const {
    return (0.5 + kJitter) * folds[5].spacing;
}

RoughField::Value RoughField::Layer::at(const glm::dvec3& p) const {
    Value value{p, glm::dmat3(1.0)};
    for (const Fold& fold : folds) fold.fold(value);
    // Now between 0 and the extent along each of the last axes.
    for (size_t k = 3; k < 6; ++k) value.vector -= folds[k].axis * (extent() / 2);
    return value;
}

}  // namespace sherd
