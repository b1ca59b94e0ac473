// SPDX-License-Identifier: MIT
#include "mesh.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <map>
#include <utility>

namespace sherd::samples {
namespace {

using DirectedEdge = std::pair<uint32_t, uint32_t>;

struct EdgeUse {
    uint32_t triangle;
    uint32_t corner;
};

std::map<DirectedEdge, EdgeUse> directedEdges(const Mesh& mesh, bool& repeated) {
    std::map<DirectedEdge, EdgeUse> edges;
    repeated = false;
    for (uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        for (uint32_t k = 0; k < 3; ++k) {
            const DirectedEdge key{mesh.triangles[t][k].position,
                                   mesh.triangles[t][(k + 1) % 3].position};
            if (!edges.emplace(key, EdgeUse{t, k}).second) repeated = true;
        }
    }
    return edges;
}

glm::dvec3 corner(const Mesh& mesh, const Triangle& triangle, uint32_t k) {
    return mesh.positions[triangle[k].position];
}

glm::dvec3 areaNormal(const Mesh& mesh, const Triangle& triangle) {
    const glm::dvec3 a = corner(mesh, triangle, 0);
    return glm::cross(corner(mesh, triangle, 1) - a, corner(mesh, triangle, 2) - a);
}

double cornerAngle(const Mesh& mesh, const Triangle& triangle, uint32_t k) {
    const glm::dvec3 p = corner(mesh, triangle, k);
    const glm::dvec3 a = glm::normalize(corner(mesh, triangle, (k + 1) % 3) - p);
    const glm::dvec3 b = glm::normalize(corner(mesh, triangle, (k + 2) % 3) - p);
    return std::acos(std::clamp(glm::dot(a, b), -1.0, 1.0));
}

}  // namespace

EdgeFlags findSeams(const Mesh& mesh) {
    bool repeated = false;
    const auto edges = directedEdges(mesh, repeated);
    EdgeFlags seams(mesh.triangles.size(), {false, false, false});
    for (const auto& [key, use] : edges) {
        const auto other = edges.find({key.second, key.first});
        if (other == edges.end()) {
            seams[use.triangle][use.corner] = true;
            continue;
        }
        const Triangle& mine = mesh.triangles[use.triangle];
        const Triangle& theirs = mesh.triangles[other->second.triangle];
        const uint32_t k = other->second.corner;
        seams[use.triangle][use.corner] = mine[use.corner].uv != theirs[(k + 1) % 3].uv ||
                                          mine[(use.corner + 1) % 3].uv != theirs[k].uv;
    }
    return seams;
}

bool isClosedManifold(const Mesh& mesh) {
    bool repeated = false;
    const auto edges = directedEdges(mesh, repeated);
    const bool paired = std::all_of(edges.begin(), edges.end(), [&](const auto& edge) {
        return edges.contains({edge.first.second, edge.first.first});
    });
    const bool solid = std::all_of(
        mesh.triangles.begin(), mesh.triangles.end(),
        [&](const Triangle& triangle) { return glm::length(areaNormal(mesh, triangle)) > 0; });
    std::vector<std::array<float, 3>> places;
    places.reserve(mesh.positions.size());
    for (const glm::vec3& p : mesh.positions) places.push_back({p.x, p.y, p.z});
    std::sort(places.begin(), places.end());
    const bool welded = std::adjacent_find(places.begin(), places.end()) == places.end();
    return !repeated && paired && solid && welded;
}

double signedVolume(const Mesh& mesh) {
    double six = 0;
    for (const Triangle& triangle : mesh.triangles) {
        six += glm::dot(corner(mesh, triangle, 0),
                        glm::cross(corner(mesh, triangle, 1), corner(mesh, triangle, 2)));
    }
    return six / 6;
}

void computeNormals(Mesh& mesh, double creaseDegrees) {
    std::vector<glm::dvec3> faces(mesh.triangles.size());
    std::vector<std::vector<EdgeUse>> around(mesh.positions.size());
    for (uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        faces[t] = glm::normalize(areaNormal(mesh, mesh.triangles[t]));
        for (uint32_t k = 0; k < 3; ++k) {
            around[mesh.triangles[t][k].position].push_back({t, k});
        }
    }
    const double smooth = std::cos(glm::radians(creaseDegrees));
    for (uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        for (Corner& here : mesh.triangles[t]) {
            glm::dvec3 sum(0);
            for (const EdgeUse& use : around[here.position]) {
                if (glm::dot(faces[use.triangle], faces[t]) < smooth) continue;
                sum += faces[use.triangle] *
                       cornerAngle(mesh, mesh.triangles[use.triangle], use.corner);
            }
            here.normal = glm::normalize(sum);
        }
    }
}

}  // namespace sherd::samples
