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

/// The hull of at most `count` points, of a volume whatever comes in.
Polytope hullOfFew(const std::vector<glm::dvec3>& points, uint32_t count) {
    const Span span = spanOf(points);
    std::vector<glm::dvec3> chosen;
    if (span.dimension == 3) {
        Polytope hull = hullOf(points);
        if (hull.points.size() <= count) return hull;
        const std::vector<glm::dvec3>& corners = hull.points;
        for (const uint32_t i : selectHullVertices(corners, spanOf(corners), {.count = count}))
            chosen.push_back(corners[i]);
        return hullOf(chosen);
    }
    for (const uint32_t i : selectHullVertices(points, span, {.count = count / 2}))
        chosen.push_back(points[i]);
    if (span.dimension == 2) return hullOf(thicken(chosen, span.direction));
    const glm::dvec3 side = anyPerpendicular(span.direction);
    return hullOf(thicken(thicken(chosen, side), glm::cross(span.direction, side)));
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
    double depth = 0;   ///< at a corner
    double volume = 0;  ///< of the hull, as a share of its own
};

/// How much may be left out.
struct Loss {
    double depth, volume;
};

Shrunk shrunkBy(double margin, const Polytope& hull, const std::vector<HalfSpace>& halfSpaces) {
    Shrunk out{shrinkHull(hull.points, halfSpaces, margin), margin, 0, 0};
    for (size_t i = 0; i < hull.points.size(); ++i)
        out.depth = std::max(out.depth, glm::distance(hull.points[i], out.points[i]) - margin);
    const double whole = volumeOf(hull);
    // Moved corners keep their faces, all but: good enough for a share, and no hull to be found.
    if (margin > 0) out.volume = 1 - roundedVolume({out.points, hull.faces, {}}, margin) / whole;
    return out;
}

/// A smaller margin until it rounds off no more than it may. What that costs at a corner is
/// proportional to the margin, at an edge to its square: the step is that of corners where they are
/// too much, that of edges where the volume is.
Shrunk shrunkWithin(const Loss& loss, double margin, const Polytope& hull,
                    const std::vector<HalfSpace>& halfSpaces) {
    const auto step = [&](const Shrunk& s) {
        double share = 1;
        if (s.depth > loss.depth) share = 0.95 * loss.depth / s.depth;
        if (s.volume > loss.volume)
            share = std::min(share, 0.95 * std::sqrt(loss.volume / s.volume));
        return share;
    };
    Shrunk out = shrunkBy(margin, hull, halfSpaces);
    for (int k = 0; k < 6 && step(out) < 1; ++k)
        out = shrunkBy(out.margin * step(out), hull, halfSpaces);
    return step(out) < 1 ? shrunkBy(0, hull, halfSpaces) : out;
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
    const Polytope hull = hullOfFew(unit, count);
    const std::vector<HalfSpace> halfSpaces = halfSpacesOf(hull);
    const double margin =
        std::min(setting / frame.size, 0.1 * thinnestExtent(hull.points, halfSpaces));

    const Shrunk shrunk =
        shrunkWithin({options.reach / frame.size, 1 - options.volume}, margin, hull, halfSpaces);
    ColliderHull out = placed(shrunk.points, frame);
    out.margin = static_cast<float>(shrunk.margin * frame.size);
    if (spansVolume(out, frame)) return out;
    // A needle may shrink to points that floats cannot tell apart: it keeps its corners and no
    // margin.
    return placed(hull.points, frame);
}

}  // namespace sherd
