// SPDX-License-Identifier: MIT
// Depth below the surface as an attribute of hidden faces.
#include <doctest/doctest.h>

#include <set>

#include "support/baked_set.h"
#include "support/hidden_looks.h"
#include "support/pattern_plans.h"
#include "support/surface_meshes.h"

using namespace sherd;
using namespace sherd::test;

namespace {

FractureSet bakedCube(const std::string& semantic, const SurfaceMesh& mesh = chartedCube(1, 6)) {
    Recipe recipe;
    recipe.interior.depthColor = semantic;
    return writtenSet(modelAround(mesh), patterns({"voronoi:6:3", "voronoi:20:4"}), recipe);
}

/// Of a point in the unit cube.
double depthInCube(const glm::vec3& p) {
    const glm::dvec3 q(p);
    return std::min({q.x, q.y, q.z, 1 - q.x, 1 - q.y, 1 - q.z});
}

std::set<uint32_t> verticesOf(const FractureSet& set, bool hidden) {
    std::set<uint32_t> used;
    for (const Primitive& p : set.geometry.primitives) {
        if ((p.exposedFrom > 0) != hidden) continue;
        for (uint32_t i = p.indices.first; i < p.indices.first + p.indices.count; ++i)
            used.insert(set.geometry.indices[i]);
    }
    return used;
}

/// The largest difference of an attribute's component from the depth of its vertex.
double worstDepth(const FractureSet& set, const std::string& semantic, uint32_t component) {
    const Attribute* attribute = attributeOf(set, semantic);
    REQUIRE(attribute != nullptr);
    const std::set<uint32_t> hidden = verticesOf(set, true);
    double deepest = 0, worst = 0;
    for (const uint32_t v : hidden)
        deepest = std::max(deepest, depthInCube(set.geometry.positions[v]));
    for (const uint32_t v : hidden) {
        const double told = attribute->values[v * attribute->components + component];
        worst = std::max(worst, std::abs(told - depthInCube(set.geometry.positions[v]) / deepest));
    }
    return worst;
}

}  // namespace

TEST_CASE("vertex colours tell the depth of hidden faces and leave the surface white") {
    FractureSet set = bakedCube("COLOR_0");
    for (const uint32_t c : {0U, 1U, 2U}) CHECK(worstDepth(set, "COLOR_0", c) < 1e-5);
    const Attribute* color = attributeOf(set, "COLOR_0");
    size_t notWhite = 0, notOpaque = 0;
    for (const uint32_t v : verticesOf(set, false))
        for (uint32_t c = 0; c < 4; ++c) notWhite += color->values[4 * v + c] == 1 ? 0 : 1;
    for (const uint32_t v : verticesOf(set, true))
        notOpaque += color->values[4 * v + 3] == 1 ? 0 : 1;
    CHECK(notWhite == 0);
    CHECK(notOpaque == 0);
    // The judge sees one that is off.
    for (Attribute& a : set.geometry.attributes)
        if (a.semantic == "COLOR_0") a.values[4 * *verticesOf(set, true).rbegin() + 1] += 0.01F;
    CHECK(worstDepth(set, "COLOR_0", 1) > 0.009);
}

TEST_CASE("colours that the surface has stay as they are") {
    SurfaceMesh mesh = chartedCube(1, 6);
    const size_t vertices = mesh.attributes[0].values.size() / 3;
    mesh.attributes.push_back({"COLOR_0", 4, {}});
    for (size_t i = 0; i < vertices; ++i)
        mesh.attributes.back().values.insert(mesh.attributes.back().values.end(),
                                             {0.25F, 0.5F, 0.75F, 0.5F});
    const FractureSet set = bakedCube("COLOR_0", mesh);
    const Attribute* color = attributeOf(set, "COLOR_0");
    size_t changed = 0;
    for (const uint32_t v : verticesOf(set, false))
        changed += color->values[4 * v] == 0.25F && color->values[4 * v + 3] == 0.5F ? 0 : 1;
    CHECK(changed == 0);
    CHECK(worstDepth(set, "COLOR_0", 2) < 1e-5);
}

TEST_CASE("another set of colours or an attribute of the application can tell the depth") {
    const FractureSet second = bakedCube("COLOR_1");
    CHECK(worstDepth(second, "COLOR_1", 0) < 1e-5);
    // glTF numbers colours without gaps: the first set is there and white.
    for (const float value : attributeOf(second, "COLOR_0")->values) REQUIRE(value == 1);
    const FractureSet own = bakedCube("_DEPTH");
    CHECK(worstDepth(own, "_DEPTH", 0) < 1e-5);
    CHECK(attributeOf(own, "_DEPTH")->components == 1);
    CHECK(attributeOf(own, "COLOR_0") == nullptr);
    for (const uint32_t v : verticesOf(own, false))
        REQUIRE(attributeOf(own, "_DEPTH")->values[v] == 0);
    CHECK(attributeOf(bakedCube(""), "COLOR_0") == nullptr);
}
