// SPDX-License-Identifier: MIT
#include "lathe.h"

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

namespace sherd::samples {
namespace {

/// A pole is one position, shared by all angles.
class Rings {
  public:
    Rings(const Lathe& lathe, Mesh& mesh) : segments_(lathe.segments) {
        for (uint32_t ring = 0; ring < lathe.profile.size(); ++ring) {
            first_.push_back(static_cast<uint32_t>(mesh.positions.size()));
            const bool pole = ring == 0 || ring + 1 == lathe.profile.size();
            pole_.push_back(pole);
            for (uint32_t i = 0; i < (pole ? 1 : segments_); ++i) {
                const double angle = 2 * std::numbers::pi * i / segments_;
                const double radius = pole           ? 0
                                      : lathe.radius ? lathe.radius(ring, angle)
                                                     : lathe.profile[ring].radius;
                mesh.positions.emplace_back(radius * std::cos(angle), lathe.profile[ring].height,
                                            -radius * std::sin(angle));
            }
        }
    }

    uint32_t at(uint32_t ring, uint32_t i) const {
        return first_[ring] + (pole_[ring] ? 0 : i % segments_);
    }
    bool isPole(uint32_t ring) const { return pole_[ring]; }

  private:
    uint32_t segments_;
    std::vector<uint32_t> first_;
    std::vector<bool> pole_;
};

/// Share of the way from ring `first` to each ring of the chart.
std::vector<double> profileShares(const Lathe& lathe, const LatheChart& chart) {
    std::vector<double> way{0};
    for (uint32_t ring = chart.first; ring < chart.last; ++ring) {
        const ProfilePoint& a = lathe.profile[ring];
        const ProfilePoint& b = lathe.profile[ring + 1];
        way.push_back(way.back() + std::hypot(b.radius - a.radius, b.height - a.height));
    }
    for (double& w : way) w /= way.back();
    return way;
}

void addChart(const Lathe& lathe, const LatheChart& chart, const Rings& rings, Mesh& mesh) {
    const std::vector<double> shares = profileShares(lathe, chart);
    const auto corner = [&](uint32_t ring, uint32_t i) {
        Corner out;
        out.position = rings.at(ring, i);
        const glm::dvec3 p = mesh.positions[out.position];
        out.uv = chart.kind == LatheChart::Kind::disc
                     ? chart.uvFirst + glm::dvec2(p.x, p.z) * chart.uvLast
                     : glm::mix(chart.uvFirst, chart.uvLast,
                                glm::dvec2(double(i) / lathe.segments, shares[ring - chart.first]));
        return out;
    };
    for (uint32_t ring = chart.first; ring < chart.last; ++ring) {
        for (uint32_t i = 0; i < lathe.segments; ++i) {
            const Corner a = corner(ring, i);
            const Corner b = corner(ring, i + 1);
            const Corner c = corner(ring + 1, i + 1);
            const Corner d = corner(ring + 1, i);
            if (!rings.isPole(ring)) mesh.triangles.push_back({a, b, d});
            if (!rings.isPole(ring + 1)) mesh.triangles.push_back({b, c, d});
        }
    }
}

}  // namespace

Mesh turn(const Lathe& lathe) {
    Mesh mesh;
    const Rings rings(lathe, mesh);
    for (const LatheChart& chart : lathe.charts) addChart(lathe, chart, rings, mesh);
    return mesh;
}

std::vector<ProfilePoint> smoothProfile(std::span<const ProfilePoint> points, uint32_t steps) {
    const auto at = [&](ptrdiff_t i) {
        const auto last = static_cast<ptrdiff_t>(points.size()) - 1;
        const ProfilePoint& p =
            points[static_cast<size_t>(std::min(std::max<ptrdiff_t>(i, 0), last))];
        return glm::dvec2(p.radius, p.height);
    };
    std::vector<ProfilePoint> curve{points.front()};
    for (ptrdiff_t i = 0; i + 1 < static_cast<ptrdiff_t>(points.size()); ++i) {
        const glm::dvec2 inTangent = (at(i + 1) - at(i - 1)) * 0.5;
        const glm::dvec2 outTangent = (at(i + 2) - at(i)) * 0.5;
        for (uint32_t step = 1; step <= steps; ++step) {
            const double t = double(step) / steps;
            const double s = 1 - t;
            const glm::dvec2 p = at(i) * (s * s * (1 + 2 * t)) + inTangent * (s * s * t) +
                                 at(i + 1) * (t * t * (3 - 2 * t)) - outTangent * (t * t * s);
            curve.push_back({p.x, p.y});
        }
    }
    return curve;
}

}  // namespace sherd::samples
