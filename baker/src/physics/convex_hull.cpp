// SPDX-License-Identifier: MIT
// All work is done on points moved to the origin and scaled to unit size, so that tolerances mean
// the same for a crumb and for a cliff.
#include "physics/convex_hull.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "physics/hull_selection.h"
#include "physics/hull_shrink.h"

namespace sherd {
namespace {

constexpr double kFlatThickness = 1e-3;

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

std::vector<glm::dvec3> finitePoints(std::span<const glm::dvec3> points) {
    std::vector<glm::dvec3> out;
    out.reserve(points.size());
    for (const glm::dvec3& p : points) {
        if (std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)) out.push_back(p);
    }
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
    std::vector<glm::dvec3> chosen;
    if (span.dimension == 3) {
        const std::vector<glm::dvec3> corners = hullOf(points).points;
        for (const uint32_t i : selectHullVertices(corners, spanOf(corners), {.count = count}))
            chosen.push_back(corners[i]);
        return chosen;
    }
    for (const uint32_t i : selectHullVertices(points, span, {.count = count / 2}))
        chosen.push_back(points[i]);
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

namespace {

/// The corners moved inwards by a margin, and what of the hull they then leave out at most.
struct Shrunk {
    std::vector<glm::dvec3> points;
    double margin = 0;
    double loss = 0;
};

Shrunk shrunkBy(double margin, const std::vector<glm::dvec3>& corners,
                const std::vector<HalfSpace>& halfSpaces) {
    Shrunk out{shrinkHull(corners, halfSpaces, margin), margin, 0};
    for (size_t i = 0; i < corners.size(); ++i)
        out.loss = std::max(out.loss, glm::distance(corners[i], out.points[i]) - margin);
    return out;
}

/// A smaller margin until no corner is rounded off by more than `reach`: what a margin costs is
/// all but proportional to it.
Shrunk shrunkWithin(double reach, double margin, const std::vector<glm::dvec3>& corners,
                    const std::vector<HalfSpace>& halfSpaces) {
    Shrunk out = shrunkBy(margin, corners, halfSpaces);
    for (int step = 0; step < 4 && out.loss > reach; ++step)
        out = shrunkBy(out.margin * 0.95 * reach / out.loss, corners, halfSpaces);
    return out.loss > reach ? shrunkBy(0, corners, halfSpaces) : out;
}

}  // namespace

ColliderHull colliderHull(std::span<const glm::vec3> points, const HullOptions& options) {
    return colliderHull(std::vector<glm::dvec3>(points.begin(), points.end()), options);
}

ColliderHull colliderHull(std::span<const glm::dvec3> points, const HullOptions& options) {
    std::vector<glm::dvec3> unit = finitePoints(points);
    const Frame frame = frameOf(unit);
    const double setting = options.margin >= 0 ? options.margin : 0.01 * frame.size;
    if (!(frame.size > 0)) return crumb(frame.center, std::max(setting, 0.0));
    for (glm::dvec3& p : unit) p = (p - frame.center) / frame.size;

    const uint32_t count = std::clamp<uint32_t>(options.maxVertices, 8, 255);
    const std::vector<glm::dvec3> chosen = selectPoints(unit, count);
    const std::vector<HalfSpace> halfSpaces = halfSpacesOf(hullOf(chosen));
    const double margin = std::min(setting / frame.size, 0.1 * thinnestExtent(chosen, halfSpaces));

    const Shrunk shrunk = shrunkWithin(options.reach / frame.size, margin, chosen, halfSpaces);
    ColliderHull out = placed(shrunk.points, frame);
    out.margin = static_cast<float>(shrunk.margin * frame.size);
    if (spansVolume(out, frame)) return out;
    // A needle may shrink to points that floats cannot tell apart: it keeps its corners and no
    // margin.
    return placed(chosen, frame);
}

}  // namespace sherd
