// SPDX-License-Identifier: MIT
#include "surface/page_frames.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

namespace sherd {
namespace {

glm::dvec3 unitAxis(int k) {
    glm::dvec3 axis(0.0);
    axis[k] = 1;
    return axis;
}

/// Pages lie within a few tiles of [0, 1]: clamping only keeps hostile numbers on the grid.
GridPoint snapPage(const glm::dvec2& p) {
    const auto snap = [](double x) {
        if (!(x > -7.0)) x = -7.0;  // what is no number, too
        return static_cast<int32_t>(std::lround(std::min(x, 7.0) * kGridOne));
    };
    return {snap(p.x), snap(p.y)};
}

/// The page's right and down, seen along an axis: y is up, or -z where the axis is upright.
PagePlane orient(const glm::dvec3& axis) {
    const glm::dvec3 look = glm::normalize(axis);
    const glm::dvec3 up = std::abs(look.y) > 0.999 ? glm::dvec3(0, 0, -1) : glm::dvec3(0, 1, 0);
    PagePlane plane;
    plane.right = glm::normalize(glm::cross(look, up));
    plane.down = -glm::cross(plane.right, look);
    return plane;
}

PagePlane fit(const Bounds& extent, const glm::dvec3& axis) {
    PagePlane plane = orient(axis);
    glm::dvec2 low(std::numeric_limits<double>::max());
    glm::dvec2 high(std::numeric_limits<double>::lowest());
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 p((corner & 1) != 0 ? extent.high.x : extent.low.x,
                           (corner & 2) != 0 ? extent.high.y : extent.low.y,
                           (corner & 4) != 0 ? extent.high.z : extent.low.z);
        const glm::dvec2 at(glm::dot(p, plane.right), glm::dot(p, plane.down));
        low = glm::min(low, at);
        high = glm::max(high, at);
    }
    plane.origin = plane.right * low.x + plane.down * low.y;
    const auto span = [](double x) { return x > 0 ? x : 1.0; };
    plane.right /= span(high.x - low.x);
    plane.down /= span(high.y - low.y);
    return plane;
}

UvTriangle frameOf(const std::array<glm::dvec2, 3>& corner) {
    UvTriangle frame;
    for (size_t k = 0; k < 3; ++k) frame.corner[k] = snapPage(corner[k]);
    frame.kind = classify(frame.corner);
    return frame;
}

PageFrames wrapAround(const SplitSurface& surface, const glm::dvec3& wanted) {
    const Bounds extent = boundsOf(surface);
    const glm::dvec3 axis = glm::normalize(wanted);
    // With the axis upright the page's middle faces +z, and u runs towards +x there.
    const glm::dvec3 any = std::abs(axis.x) < 0.9 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 0, 1);
    const glm::dvec3 right = glm::normalize(any - axis * glm::dot(any, axis));
    const glm::dvec3 front = glm::cross(right, axis);
    double low = std::numeric_limits<double>::max();
    double high = std::numeric_limits<double>::lowest();
    for (const SplitTriangle& t : surface.triangles) {
        for (const uint32_t v : t.v) {
            const double h = glm::dot(glm::dvec3(surface.positions[v]), axis);
            low = std::min(low, h);
            high = std::max(high, h);
        }
    }
    const double span = high > low ? high - low : 1;
    const auto angle = [&](const glm::dvec3& p, bool& onAxis) {
        const glm::dvec3 d = p - extent.middle();
        const double x = glm::dot(d, right);
        const double z = glm::dot(d, front);
        onAxis = x == 0 && z == 0;
        return std::atan2(x, z) / (2 * M_PI) + 0.5;
    };
    PageFrames frames;
    frames.tilesU = 2;
    for (const SplitTriangle& t : surface.triangles) {
        std::array<glm::dvec2, 3> corner{};
        std::array<bool, 3> onAxis{};
        for (size_t k = 0; k < 3; ++k) {
            const glm::dvec3 p = surface.positions[t.v[k]];
            corner[k] = {angle(p, onAxis[k]), (high - glm::dot(p, axis)) / span};
        }
        // Over the page's edge a triangle lies in two copies of the page, beside each other.
        const auto [least, most] = std::minmax({corner[0].x, corner[1].x, corner[2].x});
        if (most - least > 0.5) {
            for (glm::dvec2& c : corner)
                if (c.x < 0.5) c.x += 1;
        }
        // A corner on the axis has no angle of its own.
        for (size_t k = 0; k < 3; ++k)
            if (onAxis[k]) corner[k].x = (corner[(k + 1) % 3].x + corner[(k + 2) % 3].x) / 2;
        frames.triangles.push_back(frameOf(corner));
    }
    return frames;
}

PageFrames ontoBox(const SurfaceMesh& mesh, const SplitSurface& surface) {
    const std::array<PagePlane, 6> planes = boxPlanes(surface);
    PageFrames frames;
    for (const SplitTriangle& t : surface.triangles) {
        std::array<glm::dvec3, 3> p{};
        for (size_t k = 0; k < 3; ++k) p[k] = surface.positions[t.v[k]];
        const uint8_t side = boxSide(mesh, t.source);
        frames.triangles.push_back(
            frameOf({planes[side].at(p[0]), planes[side].at(p[1]), planes[side].at(p[2])}));
    }
    return frames;
}

glm::dvec3 axisByExtent(const SplitSurface& surface, bool longest) {
    const glm::dvec3 size = boundsOf(surface).size();
    // Equal extents: look along z, wrap around y.
    int axis = longest ? 1 : 2;
    for (int k = 0; k < 3; ++k)
        if (longest ? size[k] > size[axis] : size[k] < size[axis]) axis = k;
    return unitAxis(axis);
}

}  // namespace

glm::dvec2 PagePlane::at(const glm::dvec3& position) const {
    return {glm::dot(position - origin, right), glm::dot(position - origin, down)};
}

glm::dvec3 shortestAxis(const SplitSurface& surface) {
    return axisByExtent(surface, false);
}
glm::dvec3 longestAxis(const SplitSurface& surface) {
    return axisByExtent(surface, true);
}

PagePlane fitPage(const SplitSurface& surface, const glm::dvec3& axis) {
    return fit(boundsOf(surface), axis == glm::dvec3(0.0) ? -shortestAxis(surface) : axis);
}

PageFrames framesOnPlane(const SplitSurface& surface, const PagePlane& plane) {
    std::vector<GridPoint> points;
    points.reserve(surface.positions.size());
    for (const glm::vec3& p : surface.positions) points.push_back(snapPage(plane.at(p)));
    PageFrames frames;
    frames.triangles.resize(surface.triangles.size());
    for (size_t t = 0; t < surface.triangles.size(); ++t) {
        UvTriangle& frame = frames.triangles[t];
        for (size_t k = 0; k < 3; ++k) frame.corner[k] = points[surface.triangles[t].v[k]];
        frame.kind = classify(frame.corner);
    }
    return frames;
}

std::array<PagePlane, 6> boxPlanes(const SplitSurface& surface) {
    const Bounds extent = boundsOf(surface);
    std::array<PagePlane, 6> planes;
    for (int side = 0; side < 6; ++side)
        planes[static_cast<size_t>(side)] =
            fit(extent, unitAxis(side / 2) * (side % 2 == 0 ? -1.0 : 1.0));
    return planes;
}

uint8_t boxSide(const SurfaceMesh& mesh, uint32_t triangle) {
    const auto& v = mesh.triangles[triangle];
    const glm::dvec3 a = mesh.positions[v[0]];
    const glm::dvec3 normal =
        glm::cross(glm::dvec3(mesh.positions[v[1]]) - a, glm::dvec3(mesh.positions[v[2]]) - a);
    int axis = 0;
    for (int k = 1; k < 3; ++k)
        if (std::abs(normal[k]) > std::abs(normal[axis])) axis = k;
    return static_cast<uint8_t>(2 * axis + (normal[axis] < 0 ? 1 : 0));
}

PageFrames projectedFrames(const SurfaceMesh& mesh, const SplitSurface& surface,
                           const Projection& projection) {
    if (projection.kind == Projection::Kind::box) return ontoBox(mesh, surface);
    if (projection.kind == Projection::Kind::cylindrical) {
        return wrapAround(
            surface, projection.axis == glm::dvec3(0.0) ? longestAxis(surface) : projection.axis);
    }
    return framesOnPlane(surface, fitPage(surface, projection.axis));
}

}  // namespace sherd
