// SPDX-License-Identifier: MIT
#include "layout/uv_wireframe.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "layout/drawn_triangle.h"

namespace sherd {

namespace {

/// One side of a triangle; the same edge of two triangles gives equal sides.
struct Side {
    std::array<uint32_t, 2> ends;       ///< into the points, ascending
    std::array<uint64_t, 2> positions;  ///< mesh and welded position at those ends
    // NOLINTNEXTLINE(modernize-use-nullptr): clang-tidy 14 misreads a defaulted <=>
    friend auto operator<=>(const Side&, const Side&) = default;
};

struct PointLess {
    bool operator()(glm::vec2 a, glm::vec2 b) const {
        return std::tie(a.x, a.y) < std::tie(b.x, b.y);
    }
};

glm::vec2 uvOf(const Attribute& uv, uint32_t vertex) {
    const size_t at = size_t{2} * vertex;
    if (at + 1 >= uv.values.size()) return glm::vec2(NAN);
    // Adding zero makes a negative zero positive: they are one point.
    return {uv.values[at] + 0.0F, uv.values[at + 1] + 0.0F};
}

const Attribute* uvAttribute(const SurfaceMesh& mesh) {
    return mesh.uvSemantic.empty() ? nullptr : findAttribute(mesh.attributes, mesh.uvSemantic);
}

/// The mesh's triangles as they are drawn, those with points that are no numbers as they are.
template <class Visit>
void forEachDrawn(const SurfaceMesh& mesh, Visit visit) {
    const Attribute* uv = uvAttribute(mesh);
    if (uv == nullptr) return;
    for (size_t t = 0; t < mesh.corners.size(); ++t) {
        std::array<glm::vec2, 3> at{};
        for (size_t k = 0; k < 3; ++k) at[k] = uvOf(*uv, mesh.corners[t][k]);
        const uint32_t slot = t < mesh.triangleMaterials.size() ? mesh.triangleMaterials[t] : 0;
        const DrawnTriangle drawn = drawnTriangle(
            at, slot < mesh.placements.size() ? mesh.placements[slot] : TexturePlacement());
        visit(t, drawn);
    }
}

bool isFinite(glm::vec2 p) {
    return std::isfinite(p.x) && std::isfinite(p.y);
}

std::vector<glm::vec2> distinctPoints(std::span<const SurfaceMesh> meshes) {
    std::vector<glm::vec2> points;
    for (const SurfaceMesh& mesh : meshes) {
        forEachDrawn(mesh, [&](size_t, const DrawnTriangle& drawn) {
            for (const glm::vec2 p : drawn.points)
                if (isFinite(p)) points.push_back(p);
        });
    }
    std::sort(points.begin(), points.end(), PointLess());
    points.erase(std::unique(points.begin(), points.end()), points.end());
    return points;
}

void addSides(const SurfaceMesh& mesh, uint64_t meshIndex, UvWireframe& wireframe,
              std::vector<Side>& sides) {
    const std::vector<glm::vec2>& points = wireframe.points;
    forEachDrawn(mesh, [&](size_t t, const DrawnTriangle& drawn) {
        std::array<uint32_t, 3> at{};
        for (size_t k = 0; k < 3; ++k) {
            const glm::vec2 p = drawn.points[k];
            if (!isFinite(p)) return;
            const auto found = std::lower_bound(points.begin(), points.end(), p, PointLess());
            at[k] = static_cast<uint32_t>(found - points.begin());
        }
        wireframe.fromOtherTiles += drawn.where == DrawnWhere::anotherTile ? 1 : 0;
        wireframe.beyondEdge += drawn.where == DrawnWhere::beyondEdge ? 1 : 0;
        for (size_t k = 0; k < 3; ++k) {
            const size_t next = (k + 1) % 3;
            if (at[k] == at[next]) continue;
            Side side{{at[k], at[next]},
                      {meshIndex << 32U | mesh.triangles[t][k],
                       meshIndex << 32U | mesh.triangles[t][next]}};
            if (side.ends[0] > side.ends[1]) {
                std::swap(side.ends[0], side.ends[1]);
                std::swap(side.positions[0], side.positions[1]);
            }
            sides.push_back(side);
        }
    });
}

}  // namespace

UvWireframe uvWireframe(std::span<const SurfaceMesh> meshes) {
    UvWireframe out;
    out.points = distinctPoints(meshes);
    std::vector<Side> sides;
    for (size_t m = 0; m < meshes.size(); ++m) addSides(meshes[m], m, out, sides);
    std::sort(sides.begin(), sides.end());
    // Charts may lie on top of each other: the edge is drawn once, as a border if it is one of any.
    for (size_t first = 0; first < sides.size();) {
        bool border = false;
        size_t i = first;
        while (i < sides.size() && sides[i].ends == sides[first].ends) {
            size_t same = i + 1;
            while (same < sides.size() && sides[same] == sides[i]) ++same;
            border = border || same - i == 1;
            i = same;
        }
        (border ? out.borders : out.inner).push_back(sides[first].ends);
        first = i;
    }
    return out;
}

std::vector<std::vector<uint32_t>> chainEdges(size_t pointCount,
                                              std::span<const std::array<uint32_t, 2>> edges) {
    std::vector<size_t> first(pointCount + 1, 0);
    for (const auto& edge : edges)
        for (const uint32_t p : edge) ++first[p + 1];
    std::partial_sum(first.begin(), first.end(), first.begin());
    std::vector<size_t> incident(first.back());
    std::vector<size_t> next(first.begin(), first.end() - 1);
    for (size_t e = 0; e < edges.size(); ++e)
        for (const uint32_t p : edges[e]) incident[next[p]++] = e;

    std::vector<bool> used(edges.size(), false);
    next.assign(first.begin(), first.end() - 1);
    std::vector<std::vector<uint32_t>> chains;
    for (uint32_t start = 0; start < pointCount;) {
        std::vector<uint32_t> chain{start};
        for (uint32_t p = start;;) {
            while (next[p] < first[p + 1] && used[incident[next[p]]]) ++next[p];
            if (next[p] == first[p + 1]) break;
            const size_t e = incident[next[p]];
            used[e] = true;
            p = edges[e][0] == p ? edges[e][1] : edges[e][0];
            chain.push_back(p);
        }
        if (chain.size() > 1)
            chains.push_back(std::move(chain));
        else
            ++start;
    }
    return chains;
}

}  // namespace sherd
