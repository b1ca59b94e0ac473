// SPDX-License-Identifier: MIT
// All work is done on points moved to the origin and scaled to unit size, so that tolerances mean
// the same for a crumb and for a cliff. Bullet's hull (F. P. Preparata and S. J. Hong, 1977) sieves
// large inputs; which vertices are kept, and the shrinking, is decided in full precision.
#include "physics/convex_hull.h"

#include <LinearMath/btConvexHullComputer.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "physics/hull_selection.h"
#include "physics/hull_shrink.h"

namespace sherd {
namespace {

constexpr double kFlatThickness = 1e-3;

/// Point sets up to this size are searched directly.
constexpr size_t kSieveFrom = 64;
constexpr size_t kDropInnerFrom = 1024;

struct Frame {
    glm::dvec3 center{0.0};
    double size = 0;  ///< largest extent, metres
};

Frame frameOf(const std::vector<glm::dvec3>& points) {
    if (points.empty()) return {};
    glm::dvec3 low = points[0];
    glm::dvec3 high = points[0];
    for (const glm::dvec3& p : points) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    const glm::dvec3 extent = high - low;
    return {0.5 * (low + high), std::max({extent.x, extent.y, extent.z})};
}

std::vector<glm::dvec3> finitePoints(std::span<const glm::vec3> points) {
    std::vector<glm::dvec3> out;
    out.reserve(points.size());
    for (const glm::vec3& p : points) {
        if (std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)) out.emplace_back(p);
    }
    return out;
}

/// Drops what lies inside the hull of the points extreme in 26 directions, before any sorting
/// (S. G. Akl and G. T. Toussaint, A Fast Convex Hull Algorithm, 1978).
std::vector<glm::dvec3> dropInner(const std::vector<glm::dvec3>& points) {
    std::vector<glm::dvec3> extremes;
    for (int code = 0; code < 27; ++code) {
        const glm::dvec3 d(code % 3 - 1, code / 3 % 3 - 1, code / 9 - 1);
        size_t best = 0;
        for (size_t i = 1; i < points.size(); ++i) {
            if (glm::dot(d, points[i]) > glm::dot(d, points[best])) best = i;
        }
        extremes.push_back(points[best]);
    }
    const Span span = spanOf(extremes);
    if (span.dimension < 3) return points;
    std::vector<glm::dvec3> core;
    for (const uint32_t i : selectHullVertices(extremes, span, 16)) core.push_back(extremes[i]);
    const std::vector<HalfSpace> walls = supportingHalfSpaces(core);
    std::vector<glm::dvec3> out;
    for (const glm::dvec3& p : points) {
        const bool isOuter = std::any_of(walls.begin(), walls.end(), [&](const HalfSpace& h) {
            return glm::dot(h.normal, p) > h.offset - 1e-9;
        });
        if (isOuter) out.push_back(p);
    }
    return out;
}

/// The points on the hull (to Bullet's rounding, 1e-4), as they were.
std::vector<glm::dvec3> sieve(std::vector<glm::dvec3> points) {
    if (points.size() < kSieveFrom) return points;
    if (points.size() >= kDropInnerFrom) points = dropInner(points);
    btConvexHullComputer hull;
    hull.compute(&points[0].x, sizeof(glm::dvec3), static_cast<int>(points.size()), 0, 0);
    std::vector<int> kept;
    for (int i = 0; i < hull.original_vertex_index.size(); ++i) {
        const int index = hull.original_vertex_index[i];
        if (index >= 0 && static_cast<size_t>(index) < points.size()) kept.push_back(index);
    }
    std::sort(kept.begin(), kept.end());
    kept.erase(std::unique(kept.begin(), kept.end()), kept.end());
    if (kept.size() < 4) return points;
    std::vector<glm::dvec3> out;
    out.reserve(kept.size());
    for (const int index : kept) out.push_back(points[static_cast<size_t>(index)]);
    return out;
}

glm::dvec3 anyPerpendicular(const glm::dvec3& d) {
    const glm::dvec3 size = glm::abs(d);
    glm::dvec3 axis(1, 0, 0);
    if (size.y <= size.x && size.y <= size.z) {
        axis = {0, 1, 0};
    } else if (size.z <= size.x && size.z <= size.y) {
        axis = {0, 0, 1};
    }
    return glm::normalize(glm::cross(d, axis));
}

/// Every point doubled to both sides along `direction`.
std::vector<glm::dvec3> thicken(const std::vector<glm::dvec3>& points,
                                const glm::dvec3& direction) {
    std::vector<glm::dvec3> out;
    for (const glm::dvec3& p : points) {
        out.push_back(p + 0.5 * kFlatThickness * direction);
        out.push_back(p - 0.5 * kFlatThickness * direction);
    }
    return out;
}

/// At most `count` points that span a volume, whatever comes in.
std::vector<glm::dvec3> selectPoints(const std::vector<glm::dvec3>& points, uint32_t count) {
    const Span span = spanOf(points);
    const uint32_t wanted = span.dimension == 3 ? count : count / 2;
    std::vector<glm::dvec3> chosen;
    for (const uint32_t i : selectHullVertices(points, span, wanted)) chosen.push_back(points[i]);
    if (span.dimension == 2) return thicken(chosen, span.direction);
    if (span.dimension == 1) {
        const glm::dvec3 side = anyPerpendicular(span.direction);
        return thicken(thicken(chosen, side), glm::cross(span.direction, side));
    }
    return chosen;
}

/// What a point, or nothing, collides as: a cube of a size that floats can still tell apart.
ColliderHull crumb(const glm::dvec3& at, double wantedMargin) {
    const double reach = std::max({std::abs(at.x), std::abs(at.y), std::abs(at.z), 1e-6});
    const double half = 1e-5 * reach;
    const double margin = std::min(wantedMargin, 0.2 * half);
    ColliderHull out;
    out.margin = static_cast<float>(margin);
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 sign((corner & 1) != 0 ? 1 : -1, (corner & 2) != 0 ? 1 : -1,
                              (corner & 4) != 0 ? 1 : -1);
        out.points.emplace_back(at + (half - margin) * sign);
    }
    return out;
}

ColliderHull placed(const std::vector<glm::dvec3>& points, const Frame& frame) {
    ColliderHull out;
    for (const glm::dvec3& p : points) out.points.emplace_back(frame.center + frame.size * p);
    return out;
}

/// Whether the points still do so once they are floats.
bool spansVolume(const ColliderHull& hull, const Frame& frame) {
    std::vector<glm::dvec3> unit;
    for (const glm::vec3& p : hull.points)
        unit.push_back((glm::dvec3(p) - frame.center) / frame.size);
    return spanOf(unit).dimension == 3;
}

}  // namespace

ColliderHull colliderHull(std::span<const glm::vec3> points, const HullOptions& options) {
    std::vector<glm::dvec3> unit = finitePoints(points);
    const Frame frame = frameOf(unit);
    const double setting = options.margin >= 0 ? options.margin : 0.01 * frame.size;
    if (!(frame.size > 0)) return crumb(frame.center, std::max(setting, 0.0));
    for (glm::dvec3& p : unit) p = (p - frame.center) / frame.size;

    const uint32_t count = std::clamp<uint32_t>(options.maxVertices, 8, 64);
    const std::vector<glm::dvec3> chosen = selectPoints(sieve(std::move(unit)), count);
    const std::vector<HalfSpace> halfSpaces = supportingHalfSpaces(chosen);
    const double margin = std::min(setting / frame.size, 0.1 * thinnestExtent(chosen, halfSpaces));

    ColliderHull out = placed(shrinkHull(chosen, halfSpaces, margin), frame);
    out.margin = static_cast<float>(margin * frame.size);
    if (spansVolume(out, frame)) return out;
    // A needle may shrink to points that floats cannot tell apart: it keeps its corners and no
    // margin.
    return placed(chosen, frame);
}

}  // namespace sherd
