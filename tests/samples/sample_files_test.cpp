// SPDX-License-Identifier: MIT
// The files sherd-sample-assets has written, read back as any model.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "sherd/baker/bake.h"
#include "sherd/baker/import.h"
#include "sherd/baker/recipe.h"

using namespace sherd;

namespace {

SurfaceMesh loadSample(const std::string& name) {
    auto model = importModel(std::string(SHERD_DEMO "/").append(name).append(".glb"), {});
    if (!model) FAIL(model.error().message);
    REQUIRE(model->meshes.size() == 1);
    return std::move(model->meshes.front());
}

/// Uses of each edge: 1 for one along it, 1000 for one against it.
bool isClosed(const SurfaceMesh& mesh) {
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> uses;
    for (const auto& t : mesh.triangles) {
        for (size_t k = 0; k < 3; ++k) {
            const auto edge = std::minmax(t[k], t[(k + 1) % 3]);
            uses[edge] += t[k] < t[(k + 1) % 3] ? 1 : 1000;
        }
    }
    return std::all_of(uses.begin(), uses.end(),
                       [](const auto& use) { return use.second == 1001; });
}

double volumeOf(const SurfaceMesh& mesh) {
    double six = 0;
    for (const auto& t : mesh.triangles) {
        six += glm::dot(
            glm::dvec3(mesh.positions[t[0]]),
            glm::cross(glm::dvec3(mesh.positions[t[1]]), glm::dvec3(mesh.positions[t[2]])));
    }
    return six / 6;
}

struct Expected {
    std::string name;
    size_t minTriangles, maxTriangles;
    double height;  ///< metres
};

}  // namespace

TEST_CASE("every sample is one closed surface that faces outwards and stands on the floor") {
    for (const Expected& expected :
         {Expected{"vase", 6000, 15000, 0.36}, Expected{"wall", 2000, 15000, 1.2},
          Expected{"column", 6000, 15000, 1.2}, Expected{"figure", 6000, 15000, 1.0}}) {
        INFO(expected.name);
        const SurfaceMesh mesh = loadSample(expected.name);
        CHECK(mesh.warnings.empty());
        CHECK(isClosed(mesh));
        CHECK(volumeOf(mesh) > 0);
        CHECK(mesh.triangles.size() >= expected.minTriangles);
        CHECK(mesh.triangles.size() <= expected.maxTriangles);
        float low = std::numeric_limits<float>::max();
        float high = std::numeric_limits<float>::lowest();
        for (const glm::vec3& p : mesh.positions) {
            low = std::min(low, p.y);
            high = std::max(high, p.y);
        }
        CHECK(std::abs(low) < 2e-3F);
        CHECK(std::abs(high - expected.height) < 0.03);
    }
}

TEST_CASE("every sample's texture coordinates lie in the texture") {
    for (const std::string name : {"vase", "wall", "column", "figure"}) {
        INFO(name);
        const SurfaceMesh mesh = loadSample(name);
        const Attribute* uvs = findAttribute(mesh.attributes, "TEXCOORD_0");
        REQUIRE(uvs != nullptr);
        const auto [low, high] = std::minmax_element(uvs->values.begin(), uvs->values.end());
        CHECK(*low >= 0);
        CHECK(*high <= 1);
    }
}

TEST_CASE("every sample's normals are of unit length and agree with its faces") {
    for (const std::string name : {"vase", "wall", "column", "figure"}) {
        INFO(name);
        const SurfaceMesh mesh = loadSample(name);
        const Attribute* normals = findAttribute(mesh.attributes, "NORMAL");
        REQUIRE(normals != nullptr);
        size_t against = 0;
        for (size_t t = 0; t < mesh.triangles.size(); ++t) {
            const glm::vec3 a = mesh.positions[mesh.triangles[t][0]];
            const glm::vec3 face = glm::cross(mesh.positions[mesh.triangles[t][1]] - a,
                                              mesh.positions[mesh.triangles[t][2]] - a);
            for (const uint32_t corner : mesh.corners[t]) {
                const float* n = &normals->values[size_t{3} * corner];
                const glm::vec3 normal(n[0], n[1], n[2]);
                CHECK(std::abs(glm::length(normal) - 1) < 1e-4F);
                if (glm::dot(normal, face) <= 0) ++against;
            }
        }
        CHECK(against == 0);
    }
}

TEST_CASE("the samples' walls break into full pieces, but for a fifth of their surface at most") {
    for (const std::string name : {"vase", "wall"}) {
        CAPTURE(name);
        Result<Recipe> recipe = readRecipe(SHERD_DEMO "/" + name + ".recipe.json");
        REQUIRE(recipe.has_value());
        recipe->interior.type = InteriorType::solid;
        std::vector<FracturePlan> levels;
        for (const RecipeLevel& level : recipe->levels) {
            Result<FractureMap> map = readFractureMap(level.map, {});
            REQUIRE(map.has_value());
            levels.emplace_back().drawings.push_back({std::move(*map), level.projection});
        }
        const FracturePlan plan = stackLevels(std::move(levels));
        const Result<BakedObject> baked = bakeObject(loadSample(name), plan, *recipe, {});
        if (!baked) FAIL(baked.error().message);
        double share = 0;  // percent of the surface
        for (const BakeFinding& finding : baked->report.findings) {
            if (finding.code != "solid-fallback") continue;
            share = std::stod(finding.message.substr(finding.message.find("they hold ") + 10));
        }
        MESSAGE(name << ": " << share << " % of the surface keep a sheet");
        CHECK(share < 20);
        CHECK(baked->report.levels.at(2).closed == baked->report.levels.at(2).fragments);
    }
}
