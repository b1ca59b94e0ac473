// SPDX-License-Identifier: MIT
// Small surface meshes with texture coordinates, built in memory.
#pragma once

#include <array>
#include <cmath>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <vector>

#include "sherd/baker/surface_mesh.h"

namespace sherd::test {

/// Builds a mesh from triangles given by position and UV per corner; equal positions are welded.
class MeshMaker {
  public:
    struct Corner {
        glm::vec3 position;
        glm::vec2 uv;
    };
    void triangle(Corner a, Corner b, Corner c) {
        std::array<uint32_t, 3> v{};
        std::array<uint32_t, 3> corners{};
        size_t k = 0;
        for (const Corner& corner : {a, b, c}) {
            const glm::vec3& p = corner.position;
            const auto id = static_cast<uint32_t>(mesh_.positions.size());
            const auto [it, isNew] = welded_.try_emplace({p.x, p.y, p.z}, id);
            if (isNew) mesh_.positions.push_back(p);
            v[k] = it->second;
            corners[k++] = static_cast<uint32_t>(uv_.size() / 2);
            uv_.insert(uv_.end(), {corner.uv.x, corner.uv.y});
        }
        mesh_.triangles.push_back(v);
        mesh_.corners.push_back(corners);
        mesh_.triangleMaterials.push_back(0);
    }
    void quad(Corner a, Corner b, Corner c, Corner d) {
        triangle(a, b, c);
        triangle(a, c, d);
    }
    SurfaceMesh mesh() {
        SurfaceMesh result = mesh_;
        result.name = "made";
        result.materials = {-1};
        result.uvSemantic = "TEXCOORD_0";
        std::vector<float> normals;
        for (size_t i = 0; i < uv_.size() / 2; ++i)
            normals.insert(normals.end(), {0.0F, 0.0F, 1.0F});
        result.attributes = {{"NORMAL", 3, normals}, {"TEXCOORD_0", 2, uv_}};
        return result;
    }

  private:
    SurfaceMesh mesh_;
    std::vector<float> uv_;
    std::map<std::array<float, 3>, uint32_t> welded_;
};

/// The unit square in z = 0 as `cells` x `cells` quads, UV = (x, 1 - y): every UV triangle is
/// mirrored with respect to one drawn v up, as in real files.
inline SurfaceMesh flatSquare(int cells) {
    MeshMaker maker;
    const auto corner = [cells](int x, int y) {
        const glm::vec3 p(static_cast<float>(x) / cells, static_cast<float>(y) / cells, 0);
        return MeshMaker::Corner{p, {p.x, 1 - p.y}};
    };
    for (int y = 0; y < cells; ++y) {
        for (int x = 0; x < cells; ++x) {
            maker.quad(corner(x, y), corner(x + 1, y), corner(x + 1, y + 1), corner(x, y + 1));
        }
    }
    return maker.mesh();
}

/// The UV of a point of face f of `chartedCube`, given along the face's two edges in [0, 1].
inline glm::dvec2 cubeUv(int face, double s, double t) {
    const int row = face / 3;
    return {face % 3 / 4.0 + s * 0.2, row / 2.0 + t * 0.2};
}

/// The cube [0, size]^3, each face a chart of its own: face f covers UV [f % 3 / 4, + 0.2] x
/// [f / 3 / 2, + 0.2], its two edges along u and v. Faces in order: +x, -x, +y, -y, +z, -z.
inline SurfaceMesh chartedCube(float size = 1, int cells = 1) {
    MeshMaker maker;
    for (int f = 0; f < 6; ++f) {
        const int axis = f / 2;
        const bool positive = f % 2 == 0;
        const auto corner = [&](float s, float t) {
            glm::vec3 p(0.0F);
            p[axis] = positive ? size : 0.0F;
            p[(axis + 1) % 3] = s * size;
            p[(axis + 2) % 3] = t * size;
            return MeshMaker::Corner{p, cubeUv(f, s, t)};
        };
        for (int y = 0; y < cells; ++y) {
            for (int x = 0; x < cells; ++x) {
                const auto at = [&](int i, int j) {
                    return corner(static_cast<float>(x + i) / cells,
                                  static_cast<float>(y + j) / cells);
                };
                if (positive) {
                    maker.quad(at(0, 0), at(1, 0), at(1, 1), at(0, 1));
                } else {
                    maker.quad(at(0, 0), at(0, 1), at(1, 1), at(1, 0));
                }
            }
        }
    }
    return maker.mesh();
}

/// A torus of `around` x `along` quads whose chart is one square, with seams along both loops.
inline SurfaceMesh torus(int around, int along, double big = 1, double small = 0.4) {
    MeshMaker maker;
    const auto corner = [&](int i, int j) {
        const double a = 2 * M_PI * (i % around) / around;
        const double b = 2 * M_PI * (j % along) / along;
        const double r = big + small * std::cos(b);
        return MeshMaker::Corner{glm::vec3(r * std::cos(a), r * std::sin(a), small * std::sin(b)),
                                 {static_cast<float>(i) / around, static_cast<float>(j) / along}};
    };
    for (int i = 0; i < around; ++i) {
        for (int j = 0; j < along; ++j) {
            maker.quad(corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1));
        }
    }
    return maker.mesh();
}

/// With tangents of its own, whatever they mean.
inline SurfaceMesh withTangents(SurfaceMesh mesh) {
    const size_t vertices = mesh.attributes[0].values.size() / mesh.attributes[0].components;
    std::vector<float> tangents;
    for (size_t i = 0; i < vertices; ++i) tangents.insert(tangents.end(), {1, 0, 0, 1});
    mesh.attributes.push_back({"TANGENT", 4, std::move(tangents)});
    return mesh;
}

}  // namespace sherd::test
