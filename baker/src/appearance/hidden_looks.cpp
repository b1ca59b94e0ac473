// SPDX-License-Identifier: MIT
#include "appearance/hidden_looks.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "appearance/depths.h"
#include "appearance/hidden_edges.h"
#include "appearance/roughness.h"
#include "appearance/shading_fans.h"
#include "appearance/texture_charts.h"

namespace sherd {
namespace {

/// v without its part along the unit vector n, as a unit vector; 0 if nothing is left.
glm::dvec3 across(const glm::dvec3& v, const glm::dvec3& n) {
    const glm::dvec3 rest = v - n * glm::dot(n, v);
    const double length = glm::length(rest);
    return length > 1e-9 * glm::length(v) ? rest / length : glm::dvec3(0.0);
}

double angleBetween(const glm::dvec3& a, const glm::dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

std::vector<float> depthShares(const std::vector<double>& depths) {
    double deepest = 0;
    for (const double depth : depths) deepest = std::max(deepest, depth);
    std::vector<float> shares;
    shares.reserve(depths.size());
    for (const double depth : depths)
        shares.push_back(deepest > 0 ? static_cast<float>(depth / deepest) : 0.0F);
    return shares;
}

class LookMaker {
  public:
    /// `rough`: null, or how the mesh is moved. Facets and charts are those of the smooth mesh.
    LookMaker(HiddenMesh mesh, const RoughShape* rough, const InteriorSettings& settings,
              double metresPerTile)
        : rough_(rough) {
        looks_.mesh = std::move(mesh);
        const HiddenMesh& m = looks_.mesh;
        const FaceShapes shapes = faceShapes(m);
        const std::vector<uint32_t> opposite = hiddenOpposites(m);
        charts_ = textureCharts(m, opposite, shapes, metresPerTile);
        fans_ = shadingFans(m, opposite, shapes, settings);
        if (rough != nullptr) looks_.mesh.positions = rough->positions;
    }

    HiddenLooks run() {
        const auto corners = static_cast<uint32_t>(3 * looks_.mesh.faces.size());
        firstOfFan_.assign(fans_.normals.size(), kNone);
        looks_.ofCorner.reserve(corners);
        for (uint32_t c = 0; c < corners; ++c) looks_.ofCorner.push_back(vertexOf(c));
        addTangents();
        return std::move(looks_);
    }

  private:
    uint32_t vertexOf(uint32_t corner) {
        const uint32_t fan = fans_.ofCorner[corner];
        const uint32_t chart = charts_.ofFace[corner / 3];
        for (uint32_t v = firstOfFan_[fan]; v != kNone; v = links_[v].next)
            if (links_[v].chart == chart) return v;
        const ChartFrame& frame = charts_.frames[chart];
        const uint32_t position = looks_.mesh.faces[corner / 3].v[corner % 3];
        const bool hasNormal = fans_.normals[fan] != glm::dvec3(0.0);
        glm::dvec3 normal = hasNormal ? fans_.normals[fan] : frame.normal;
        if (rough_ != nullptr) normal = glm::normalize(rough_->normalMaps[position] * normal);
        looks_.vertices.push_back({position, normal, frame.uv(looks_.mesh.positions[position])});
        links_.push_back({chart, firstOfFan_[fan]});
        return firstOfFan_[fan] = static_cast<uint32_t>(links_.size() - 1);
    }

    /// As MikkTSpace (Mikkelsen, Simulation of Wrinkled Surfaces Revisited, 2008) has them: the
    /// direction in which u grows on each face around, brought into the vertex' plane, weighed by
    /// the face's angle there.
    void addTangents() {
        std::vector<glm::dvec3> sums(looks_.vertices.size(), glm::dvec3(0.0));
        for (uint32_t f = 0; f < looks_.mesh.faces.size(); ++f) addTangentsOf(f, sums);
        for (uint32_t v = 0; v < sums.size(); ++v) {
            HiddenLooks::Vertex& vertex = looks_.vertices[v];
            const ChartFrame& frame = charts_.frames[links_[v].chart];
            for (const glm::dvec3& t : {sums[v], frame.right, frame.up}) {
                vertex.tangent = across(t, vertex.normal);
                if (vertex.tangent != glm::vec3(0.0F)) break;
            }
        }
    }

    void addTangentsOf(uint32_t f, std::vector<glm::dvec3>& sums) const {
        const ChartFrame& frame = charts_.frames[charts_.ofFace[f]];
        std::array<glm::dvec3, 3> p;
        for (size_t k = 0; k < 3; ++k) p[k] = looks_.mesh.positions[looks_.mesh.faces[f].v[k]];
        const glm::dvec3 normal = glm::cross(p[1] - p[0], p[2] - p[0]);
        const double leaning = glm::dot(frame.normal, normal);
        if (!(leaning > 0)) return;
        const glm::dvec3 alongU =
            frame.right - frame.normal * (glm::dot(frame.right, normal) / leaning);
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t v = looks_.ofCorner[3 * f + k];
            const double angle = angleBetween(p[(k + 1) % 3] - p[k], p[(k + 2) % 3] - p[k]);
            sums[v] += across(alongU, looks_.vertices[v].normal) * angle;
        }
    }

    struct Link {
        uint32_t chart;
        uint32_t next;  ///< another vertex of the same fan, or kNone
    };
    const RoughShape* rough_;
    HiddenLooks looks_;
    TextureCharts charts_;
    ShadingFans fans_;
    std::vector<Link> links_;           ///< per vertex
    std::vector<uint32_t> firstOfFan_;  ///< its latest vertex
};

/// Sizes of textures and bumps that are chosen for the user, or bounded.
double tileSize(const LooksInput& input, std::vector<BakeFinding>& findings) {
    const double asked = input.settings.uvMetresPerTile;
    // Textures of smaller tiles are grey, and their coordinates have no digits left.
    const double least = 1e-6 * input.diagonal;
    if (!(asked > 0)) return input.diagonal / 4;
    if (asked < least) {
        findings.push_back({"tile-size",
                            "uvMetresPerTile is below a millionth of the object's size; a "
                            "millionth was taken",
                            "", 1});
    }
    return std::max(asked, least);
}

Roughness roughnessOf(const LooksInput& input) {
    Roughness roughness = input.settings.roughness;
    roughness.size =
        roughness.size > 0 ? std::max(roughness.size, 1e-6 * input.diagonal) : input.diagonal / 20;
    return roughness;
}

}  // namespace

HiddenLooks hiddenLooks(const LooksInput& input, HiddenMesh mesh) {
    const InteriorSettings& settings = input.settings;
    std::vector<BakeFinding> findings;
    const double tile = tileSize(input, findings);
    RoughShape rough;
    if (settings.roughness.amplitude > 0) {
        rough = roughen(input.object, input.surface, input.components, roughnessOf(input), mesh);
        findings.insert(findings.end(), rough.findings.begin(), rough.findings.end());
    }
    HiddenLooks looks =
        LookMaker(std::move(mesh), rough.positions.empty() ? nullptr : &rough, settings, tile)
            .run();
    if (!settings.depthColor.empty()) {
        looks.depths = depthShares(
            hiddenDepths(looks.mesh, TriangleBvh(input.object.positions, input.object.triangles)));
    }
    looks.findings = std::move(findings);
    return looks;
}

}  // namespace sherd
