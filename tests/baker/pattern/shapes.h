// SPDX-License-Identifier: MIT
// Closed shapes of every kind for patterns and paths, and the cuts that are tried on them.
#pragma once

#include <doctest/doctest.h>

#include <functional>
#include <glm/geometric.hpp>
#include <string>
#include <vector>

#include "sherd/baker/pattern.h"
#include "support/pattern_plans.h"
#include "support/surface_meshes.h"
#include "surface/components.h"
#include "surface/cut_surface.h"

namespace sherd::test {

/// The surface of a set of unit cells, with corners welded. Cells that touch along an edge only
/// pinch it.
inline SurfaceMesh voxels(int nx, int ny, int nz, const std::function<bool(int, int, int)>& filled,
                          const glm::vec3& size = glm::vec3(1.0F)) {
    MeshMaker maker;
    const auto has = [&](const std::array<int, 3>& c) {
        return c[0] >= 0 && c[0] < nx && c[1] >= 0 && c[1] < ny && c[2] >= 0 && c[2] < nz &&
               filled(c[0], c[1], c[2]);
    };
    for (int z = 0; z < nz; ++z)
        for (int y = 0; y < ny; ++y)
            for (int x = 0; x < nx; ++x) {
                if (!has({x, y, z})) continue;
                for (int f = 0; f < 6; ++f) {
                    const int axis = f / 2;
                    const int side = f % 2;
                    std::array<int, 3> neighbour{x, y, z};
                    neighbour[static_cast<size_t>(axis)] += side == 1 ? 1 : -1;
                    if (has(neighbour)) continue;
                    const auto corner = [&](int s, int t) {
                        glm::vec3 p(x, y, z);
                        p[axis] += static_cast<float>(side);
                        p[(axis + 1) % 3] += static_cast<float>(s);
                        p[(axis + 2) % 3] += static_cast<float>(t);
                        return MeshMaker::Corner{p * size, {0.5F, 0.5F}};
                    };
                    if (side == 1)
                        maker.quad(corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1));
                    else
                        maker.quad(corner(0, 0), corner(0, 1), corner(1, 1), corner(1, 0));
                }
            }
    return maker.mesh();
}

/// A frame with two holes.
inline SurfaceMesh genusTwo() {
    return voxels(5, 3, 1, [](int x, int y, int) { return y != 1 || x % 2 == 0; });
}

inline SurfaceMesh thinPlate() {
    return voxels(
        16, 12, 1, [](int, int, int) { return true; }, glm::vec3(0.25F, 0.25F, 0.05F));
}

/// A ball of rings and sectors; poles are fans. Its middle is the origin.
inline SurfaceMesh ball(int rings, int sectors, double radius = 1) {
    MeshMaker maker;
    const auto corner = [&](int i, int j) {
        const double a = M_PI * i / rings;
        const double b = 2 * M_PI * (j % sectors) / sectors;
        const double r = i == 0 || i == rings ? 0 : std::sin(a);
        const glm::dvec3 p = radius * glm::dvec3(r * std::cos(b), std::cos(a), r * std::sin(b));
        return MeshMaker::Corner{glm::vec3(p),
                                 {static_cast<float>(j) / sectors, static_cast<float>(i) / rings}};
    };
    for (int i = 0; i < rings; ++i) {
        for (int j = 0; j < sectors; ++j) {
            if (i > 0) maker.triangle(corner(i, j), corner(i, j + 1), corner(i + 1, j + 1));
            if (i + 1 < rings) maker.triangle(corner(i, j), corner(i + 1, j + 1), corner(i + 1, j));
        }
    }
    return maker.mesh();
}

/// An upright tube with a wall: outer radius 1, inner 0.7, height 2.
inline SurfaceMesh tube(int sectors, int rows) {
    MeshMaker maker;
    const auto corner = [&](int i, int j, double r) {
        const double a = 2 * M_PI * (i % sectors + 0.5) / sectors;
        return MeshMaker::Corner{glm::vec3(r * std::sin(a), 2.0 * j / rows, r * std::cos(a)),
                                 {static_cast<float>(i) / sectors, static_cast<float>(j) / rows}};
    };
    for (int i = 0; i < sectors; ++i) {
        for (int j = 0; j < rows; ++j) {
            maker.quad(corner(i, j, 1), corner(i + 1, j, 1), corner(i + 1, j + 1, 1),
                       corner(i, j + 1, 1));
            maker.quad(corner(i, j, 0.7), corner(i, j + 1, 0.7), corner(i + 1, j + 1, 0.7),
                       corner(i + 1, j, 0.7));
        }
        maker.quad(corner(i, rows, 1), corner(i + 1, rows, 1), corner(i + 1, rows, 0.7),
                   corner(i, rows, 0.7));
        maker.quad(corner(i, 0, 1), corner(i, 0, 0.7), corner(i + 1, 0, 0.7), corner(i + 1, 0, 1));
    }
    return maker.mesh();
}

inline SurfaceMesh moved(SurfaceMesh mesh, const glm::vec3& by, float scale = 1) {
    for (glm::vec3& p : mesh.positions) p = p * scale + by;
    return mesh;
}

/// Several meshes as the parts of one object; vertices stay apart.
inline SurfaceMesh together(const std::vector<SurfaceMesh>& parts) {
    SurfaceMesh mesh = parts[0];
    for (size_t i = 1; i < parts.size(); ++i) {
        const auto offset = static_cast<uint32_t>(mesh.positions.size());
        const auto corners = static_cast<uint32_t>(mesh.attributes[0].values.size() / 3);
        mesh.positions.insert(mesh.positions.end(), parts[i].positions.begin(),
                              parts[i].positions.end());
        for (const auto& t : parts[i].triangles)
            mesh.triangles.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
        for (const auto& c : parts[i].corners)
            mesh.corners.push_back({c[0] + corners, c[1] + corners, c[2] + corners});
        mesh.triangleMaterials.resize(mesh.triangles.size(), 0);
        for (size_t a = 0; a < mesh.attributes.size(); ++a) {
            const auto& values = parts[i].attributes[a].values;
            mesh.attributes[a].values.insert(mesh.attributes[a].values.end(), values.begin(),
                                             values.end());
        }
    }
    return mesh;
}

struct Grown {
    MeshTopology before;
    CutSurface cut;
    Components components;
    std::vector<CellReport> reports;
    uint32_t count(uint32_t level = 1) const { return components.count.at(level - 1); }
    uint32_t strays() const { return reports.empty() ? 0 : reports[0].strays; }
};

/// Cuts and checks what must hold of every cut and of its components.
inline Grown grow(const SurfaceMesh& mesh, const FracturePlan& plan, CutOptions options = {}) {
    Grown grown;
    grown.before = buildTopology(mesh.positions, mesh.triangles);
    Result<CutSurface> cut = cutSurface(mesh, grown.before, plan, options);
    if (!cut) FAIL(cut.error().message);
    grown.cut = std::move(*cut);
    CHECK(isFaithfulSplit(mesh, grown.before, grown.cut, 1e-6));
    CHECK(grown.cut.topology.boundaryEdges >= grown.before.boundaryEdges);
    if (grown.before.boundaryEdges == 0) CHECK(grown.cut.topology.boundaryEdges == 0);
    grown.components = componentsOf(grown.cut, grown.reports);
    const Components& c = grown.components;
    CHECK(c.leaf.size() == grown.cut.surface.triangles.size());
    for (uint32_t level = 1; level <= c.levels; ++level) {
        std::vector<uint8_t> used(c.count[level - 1], 0);
        for (uint32_t leaf = 0; leaf < c.leafCount; ++leaf) used.at(c.at(level, leaf)) = 1;
        CHECK(std::count(used.begin(), used.end(), 0) == 0);
    }
    // Pieces part at lines only.
    for (uint32_t h = 0; h < 3 * c.leaf.size(); ++h) {
        const uint32_t o = grown.cut.topology.opposite[h];
        if (o == kNone || c.leaf[h / 3] == c.leaf[o / 3]) continue;
        const uint32_t mark = grown.cut.surface.triangles[h / 3].line[h % 3];
        REQUIRE(mark != 0);
        REQUIRE(mark == grown.cut.surface.triangles[o / 3].line[o % 3]);
    }
    return grown;
}

inline Grown grow(const SurfaceMesh& mesh, const std::string& text) {
    return grow(mesh, patterns({text}));
}

}  // namespace sherd::test
