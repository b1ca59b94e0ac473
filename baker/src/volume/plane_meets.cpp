// SPDX-License-Identifier: MIT
#include "volume/plane_meets.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <vector>

#include "volume/cut_grid.h"

namespace sherd {
namespace {

/// In units of the mesh's cube, whose half side is 1; normals of length 1.
struct Plane {
    glm::dvec3 normal;
    double offset;
    double at(const glm::dvec3& p) const { return glm::dot(normal, p) + offset; }
};
constexpr double kNear = 2e-6;

Plane unitPlane(const LinearFunction& f) {
    const double slope = slopeOf(f);
    const glm::dvec3 normal(static_cast<double>(f.x), static_cast<double>(f.y),
                            static_cast<double>(f.z));
    return {normal / slope, static_cast<double>(f.c) / slope / CutGrid::kReach};
}

/// Where two planes come nearest to the middle of the cube, and the direction of their line.
bool lineOf(const Plane& a, const Plane& b, glm::dvec3& point, glm::dvec3& along) {
    along = glm::cross(a.normal, b.normal);
    const double sine2 = glm::dot(along, along);
    if (sine2 < 1e-18) return false;
    point =
        (a.offset * glm::cross(along, b.normal) + b.offset * glm::cross(a.normal, along)) / sine2;
    along /= std::sqrt(sine2);
    return true;
}

bool inCube(const glm::dvec3& p) {
    const glm::dvec3 size = glm::abs(p);
    return std::max({size.x, size.y, size.z}) <= 1 + kNear;
}

}  // namespace

uint32_t mostMeeting(std::span<const LinearFunction> functions) {
    std::vector<Plane> planes;
    for (const LinearFunction& f : functions) planes.push_back(unitPlane(f));
    size_t most = std::min<size_t>(planes.size(), 1);
    for (size_t i = 0; i < planes.size(); ++i) {
        for (size_t j = 0; j < i; ++j) {
            glm::dvec3 point, along;
            if (!lineOf(planes[i], planes[j], point, along)) continue;
            // The line is as near the cube's middle as anywhere in `point`.
            if (glm::length(point) > std::sqrt(3) + kNear) continue;
            size_t throughLine = 0;
            for (const Plane& p : planes) {
                const bool through =
                    std::abs(p.at(point)) <= kNear && std::abs(glm::dot(p.normal, along)) <= kNear;
                throughLine += through ? 1 : 0;
            }
            most = std::max(most, throughLine);
            for (size_t k = 0; k < j; ++k) {
                const double slope = glm::dot(planes[k].normal, along);
                if (std::abs(slope) < 1e-9) continue;
                const glm::dvec3 meet = point - along * (planes[k].at(point) / slope);
                if (!inCube(meet)) continue;
                most = std::max<size_t>(
                    most, std::count_if(planes.begin(), planes.end(), [&](const Plane& p) {
                        return std::abs(p.at(meet)) <= kNear;
                    }));
            }
        }
    }
    return static_cast<uint32_t>(most);
}

}  // namespace sherd
