// SPDX-License-Identifier: MIT
#include "volume/slab_cells.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <string>
#include <utility>

#include "geometry/dice.h"
#include "volume/plane_meets.h"

namespace sherd {
namespace {

constexpr uint32_t kMostSlabs = 1000;
constexpr size_t kMostPlanes = 16;
constexpr uint32_t kMostMeeting = 8;  ///< takes 0.05 s; 12 in a point took 3 s, 16 minutes
/// Slopes of a family stay below a quarter of what sums may have: room for three families.
constexpr double kFamilySlope = static_cast<double>(CellFunctions::kLargestSlope) / 4;

/// The longest normal of which `count` add up to no more than a family's slopes: a power of two.
double normalLength(size_t count, double share) {
    return std::exp2(std::floor(std::log2(kFamilySlope * share / static_cast<double>(count))));
}

/// length times the distance beyond the plane, in grid steps.
Result<LinearFunction> beyond(const CutPlane& plane, const CutGrid& grid, double length,
                              size_t index) {
    const std::string where = "plane " + std::to_string(index);
    const double size = glm::length(plane.normal);
    if (!(size > 0) || !std::isfinite(size))
        return fail(ErrorCode::badArgument, "a plane's normal has no direction", where);
    const glm::dvec3 point = grid.toGrid(plane.point);
    const glm::dvec3 away = glm::abs(point);
    if (!(away.x <= CutGrid::kFarthest && away.y <= CutGrid::kFarthest &&
          away.z <= CutGrid::kFarthest)) {
        return fail(ErrorCode::badArgument,
                    "a plane is no number, or farther than twice the mesh's extent from it", where);
    }
    const glm::dvec3 normal = glm::round(plane.normal * (length / size));
    return LinearFunction{static_cast<int64_t>(normal.x), static_cast<int64_t>(normal.y),
                          static_cast<int64_t>(normal.z), -std::llround(glm::dot(normal, point))};
}

Result<CellFamily> slabs(std::span<const CutPlane> planes, const CutGrid& grid, double share) {
    CellFamily family;
    family.functions.emplace_back();
    family.slabs = true;
    const double length = normalLength(std::max<size_t>(planes.size(), 1), share);
    for (size_t k = 0; k < planes.size(); ++k) {
        const Result<LinearFunction> f = beyond(planes[k], grid, length, k);
        if (!f) return tl::unexpected(f.error());
        family.functions.push_back(family.functions.back() - *f);
    }
    return family;
}

/// Whether two families of two slabs each have the same plane between them.
bool samePlane(const CellFamily& a, const CellFamily& b) {
    const LinearFunction f = a.functions[1], g = b.functions[1];
    const auto equal = [&](int64_t sign) {
        return f.x == sign * g.x && f.y == sign * g.y && f.z == sign * g.z && f.c == sign * g.c;
    };
    return equal(1) || equal(-1);
}

/// The planes between the slabs of one axis.
std::vector<CutPlane> slicePlanes(const SliceOptions& options, int axis, const glm::dvec3& low,
                                  const glm::dvec3& high, Dice& dice) {
    const uint32_t count = options.counts[static_cast<size_t>(axis)];
    const double thickness = (high[axis] - low[axis]) / count;
    std::vector<CutPlane> planes;
    for (uint32_t k = 1; k < count; ++k) {
        CutPlane plane;
        plane.point = (low + high) * 0.5;
        const double shift = 0.5 * options.offsetJitter * dice.signedUnit();
        plane.point[axis] = low[axis] + thickness * (k + shift);
        const double tilt = options.angleJitter * dice.unit() * std::numbers::pi / 4;
        const double around = dice.unit() * 2 * std::numbers::pi;
        plane.normal[axis] = std::cos(tilt);
        plane.normal[(axis + 1) % 3] = std::sin(tilt) * std::cos(around);
        plane.normal[(axis + 2) % 3] = std::sin(tilt) * std::sin(around);
        planes.push_back(plane);
    }
    return planes;
}

}  // namespace

Result<CellFamily> slabCells(std::span<const CutPlane> planes, const CutGrid& grid) {
    return slabs(planes, grid, 1);
}

Result<std::vector<CellFamily>> planeCells(std::span<const CutPlane> planes, const CutGrid& grid) {
    if (planes.size() > kMostPlanes) {
        return fail(ErrorCode::limitExceeded,
                    "at most " + std::to_string(kMostPlanes) + " planes at once");
    }
    std::vector<CellFamily> families;
    std::vector<LinearFunction> distinct;
    for (size_t k = 0; k < planes.size(); ++k) {
        Result<CellFamily> family = slabs(planes.subspan(k, 1), grid, 3.0 / kMostPlanes);
        if (!family) {
            family.error().where = "plane " + std::to_string(k);
            return tl::unexpected(family.error());
        }
        if (std::none_of(families.begin(), families.end(),
                         [&](const CellFamily& other) { return samePlane(other, *family); })) {
            distinct.push_back(family->functions[1]);
            families.push_back(std::move(*family));
        }
    }
    if (mostMeeting(distinct) > kMostMeeting) {
        return fail(ErrorCode::limitExceeded, "more than " + std::to_string(kMostMeeting) +
                                                  " planes meet in one point: move some apart");
    }
    return families;
}

Result<std::vector<CellFamily>> sliceCells(const SliceOptions& options, const glm::dvec3& low,
                                           const glm::dvec3& high, const CutGrid& grid) {
    for (const double jitter : {options.offsetJitter, options.angleJitter}) {
        if (!(jitter >= 0 && jitter <= 1))
            return fail(ErrorCode::badArgument, "jitter must be between 0 and 1");
    }
    Dice dice(options.seed);
    std::vector<CellFamily> families;
    for (int axis = 0; axis < 3; ++axis) {
        const uint32_t count = options.counts[static_cast<size_t>(axis)];
        if (count < 1 || count > kMostSlabs) {
            return fail(ErrorCode::badArgument,
                        "slices along an axis must be 1 to " + std::to_string(kMostSlabs));
        }
        Result<CellFamily> family = slabs(slicePlanes(options, axis, low, high, dice), grid, 1);
        if (!family) return tl::unexpected(family.error());
        families.push_back(std::move(*family));
    }
    return families;
}

}  // namespace sherd
