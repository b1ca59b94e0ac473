// SPDX-License-Identifier: MIT
// What labels and lines say, in the fracture set and in the file.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "shapes.h"
#include "sherd/baker/bake.h"
#include "sherd/formats/glb_read.h"
#include "support/baked_file.h"
#include "support/plans.h"

using namespace sherd;
using namespace sherd::test;

namespace {

/// Rings around the charted cube at heights z, each from its level on.
FractureMap rings(const std::vector<std::pair<double, uint32_t>>& heights) {
    FractureMap map;
    for (const auto& [z, level] : heights) {
        for (const int face : {0, 1})
            map.lines.push_back(
                {{cubeUv(face, -0.01, z), cubeUv(face, 1.01, z)}, level, "ring", {}});
        for (const int face : {2, 3})
            map.lines.push_back(
                {{cubeUv(face, z, -0.01), cubeUv(face, z, 1.01)}, level, "ring", {}});
    }
    return map;
}

FractureMap::Label labelAt(const glm::dvec3& point, const std::string& name = "") {
    FractureMap::Label label;
    label.place = {true, point};
    label.name = name;
    label.source = "label " + name;
    return label;
}

BakedObject bakeCube(const FractureMap& map, const Recipe& recipe = {}) {
    Result<BakedObject> baked = bakeObject(chartedCube(1, 3), planOf(map), recipe, 0);
    if (!baked) FAIL(baked.error().message);
    return std::move(*baked);
}

const Fragment* named(const FractureSet& set, const std::string& name) {
    for (const Fragment& f : set.fragments)
        if (f.name == name) return &f;
    return nullptr;
}

size_t findings(const BakedObject& baked, const std::string& code) {
    size_t count = 0;
    for (const BakeFinding& f : baked.report.findings) count += f.code == code ? f.count : 0;
    return count;
}

/// The file check passes what the baker writes.
void checkFile(const SurfaceMesh& mesh, const FracturePlan& plan) {
    CHECK(checkBaked(mesh, plan).passed());
}

}  // namespace

TEST_CASE("a label names its fragment, and its numbers reach all that it consists of") {
    FractureMap map = rings({{0.4, 1}, {0.7, 2}});
    FractureMap::Label label = labelAt({1, 0.5, 0.9}, "top");
    label.level = 1;
    label.material = "oak";
    label.density = 300.0F;
    label.strength = 5e5F;
    label.toughness = 7.0F;
    map.labels.push_back(label);
    const BakedObject baked = bakeCube(map);
    const FractureSet& set = baked.set;
    const Fragment* top = named(set, "top");
    REQUIRE(top != nullptr);
    CHECK(top->level == 1);
    CHECK(top->children.count == 2);
    CHECK(top->density == 300.0F);
    CHECK(top->mass == doctest::Approx(300 * top->volume));
    double mass = 0;
    for (uint32_t c = 0; c < 2; ++c) {
        const Fragment& child = set.fragments[top->children.first + c];
        CHECK(child.name.empty());
        CHECK(child.material == "oak");
        CHECK(child.density == 300.0F);
        CHECK(child.strength == 5e5F);
        CHECK(child.toughness == 7.0F);
        mass += child.mass;
    }
    CHECK(mass == doctest::Approx(top->mass));
    // The whole is a mixture, and the masses of its parts add up to its own.
    const Fragment& whole = set.fragments[0];
    CHECK((whole.density > 300 && whole.density < 1000));
    CHECK(whole.mass == doctest::Approx(set.fragments[1].mass + set.fragments[2].mass));
    CHECK(whole.mass == doctest::Approx(whole.density * whole.volume));
    CHECK(whole.material.empty());
    // The centre of mass sinks towards the heavy bottom.
    CHECK(whole.centerOfMass.z < 0.45F);
    for (const Bond& bond : set.bonds) {
        CHECK(bond.strength == 5e5F);  // the weaker side's, here all bonds have a labelled side
        CHECK(bond.toughness == 7.0F);
    }
    checkFile(chartedCube(1, 3), planOf(map));
}

TEST_CASE("a deeper label wins over a shallower, a later over an earlier") {
    FractureMap map = rings({{0.4, 1}, {0.7, 2}});
    FractureMap::Label deep = labelAt({0.5, 0.5, 1}, "cap");
    deep.density = 50.0F;
    FractureMap::Label shallow = labelAt({0.5, 0.5, 1}, "top");
    shallow.level = 1;
    shallow.density = 300.0F;
    shallow.strength = 9.0F;
    map.labels = {deep, shallow};  // whatever the order
    const BakedObject baked = bakeCube(map);
    REQUIRE(named(baked.set, "cap") != nullptr);
    CHECK(named(baked.set, "cap")->density == 50.0F);
    CHECK(named(baked.set, "cap")->strength == 9.0F);
    CHECK((named(baked.set, "top")->density > 50 && named(baked.set, "top")->density < 300));
    CHECK(findings(baked, "label") == 0);

    FractureMap::Label other = labelAt({0.4, 0.4, 1}, "lid");
    other.density = 70.0F;
    map.labels = {deep, other};
    const BakedObject twice = bakeCube(map);
    CHECK(findings(twice, "label") == 1);
    REQUIRE(named(twice.set, "lid") != nullptr);
    CHECK(named(twice.set, "lid")->density == 70.0F);
    CHECK(named(twice.set, "cap") == nullptr);
    // A nameless one contradicts nobody.
    map.labels[1].name.clear();
    CHECK(findings(bakeCube(map), "label") == 0);
}

TEST_CASE("labels off the surface are reported and left out") {
    FractureMap map = rings({{0.4, 1}});
    map.labels.push_back(labelAt({9, 9, 9}, "far"));
    map.labels.push_back(labelAt({std::nan(""), 0, 0}, "nowhere"));
    map.labels.push_back(labelAt({0, 0, 0}, "between charts"));
    map.labels.back().place = {false, {0.22, 0.1, 0}};
    const BakedObject baked = bakeCube(map);
    CHECK(findings(baked, "label") == 3);
    for (const Fragment& f : baked.set.fragments) CHECK(f.name.empty());
}

TEST_CASE("labels in UV, at vertices, on lines and at levels too deep find a fragment") {
    FractureMap map = rings({{0.4, 1}});
    map.labels.push_back(labelAt({0, 0, 0}, "bottom"));
    map.labels.back().place = {false, glm::dvec3(cubeUv(0, 0.5, 0.1), 0)};
    map.labels.push_back(labelAt({1, 1, 1}, "top"));
    map.labels.back().level = 9;
    const BakedObject baked = bakeCube(map);
    CHECK(findings(baked, "label") == 0);
    REQUIRE((named(baked.set, "top") != nullptr && named(baked.set, "bottom") != nullptr));
    CHECK(named(baked.set, "top")->centerOfMass.z > named(baked.set, "bottom")->centerOfMass.z);
    map.labels = {labelAt({1, 0.5, 0.4}, "on the line")};
    CHECK(findings(bakeCube(map), "label") == 0);
}

TEST_CASE("labels mean the level their map names, also where levels without lines close up") {
    FractureMap map = rings({{0.4, 2}, {0.7, 5}});
    for (const uint32_t level : {1U, 2U, 4U, 5U, 9U}) {
        map.labels.push_back(labelAt({1, 0.5, 0.9}, "level " + std::to_string(level)));
        map.labels.back().level = level;
    }
    const BakedObject baked = bakeCube(map);
    const FractureSet& set = baked.set;
    // Nothing is cut at level 1 yet; 4 is as 2, and beyond 5 there is nothing deeper.
    CHECK(set.fragments[0].name == "level 1");
    REQUIRE((named(set, "level 4") != nullptr && named(set, "level 9") != nullptr));
    CHECK(named(set, "level 4")->level == 1);
    CHECK(named(set, "level 9")->level == 2);
    CHECK(findings(baked, "label") == 2);  // of four names two stand
}

TEST_CASE("an anchor is a bond to the world for every leaf below it, in a file that passes") {
    FractureMap map = rings({{0.4, 1}, {0.7, 2}});
    FractureMap::Label label = labelAt({1, 0.5, 0.9}, "held");
    label.level = 1;
    label.anchor = true;
    label.strength = 123.0F;
    map.labels = {label, label};  // twice is no more
    const BakedObject baked = bakeCube(map);
    const Fragment* held = named(baked.set, "held");
    REQUIRE(held != nullptr);
    std::set<int32_t> leaves;
    double area = 0;
    for (const Bond& bond : baked.set.bonds) {
        if (bond.b != -1) continue;
        CHECK(leaves.insert(bond.a).second);
        CHECK(static_cast<uint32_t>(bond.a) >= held->children.first);
        CHECK(static_cast<uint32_t>(bond.a) < held->children.first + held->children.count);
        CHECK(bond.strength == 123.0F);
        CHECK(glm::length(bond.normal) == doctest::Approx(1));
        CHECK(bond.centroid.z > 0.4F);
        area += bond.area;
    }
    CHECK(leaves.size() == 2);
    CHECK(area == doctest::Approx(0.5 * (4 * 0.6 + 1)).epsilon(1e-4));
    checkFile(chartedCube(1, 3), planOf(map));
    // The object itself may be anchored: all leaves are.
    const SurfaceMesh ballMesh = ball(8, 12);
    FracturePlan plan = patterns({"voronoi:6"});
    plan.drawings.emplace_back();
    plan.drawings[0].map.labels = {labelAt({0, 1, 0}, "rock")};
    plan.drawings[0].map.labels[0].anchor = true;
    checkFile(ballMesh, plan);
}

TEST_CASE("what a line says reaches the bonds along it and no others") {
    FractureMap map = rings({{0.3, 1}, {0.6, 1}});
    for (size_t i = 0; i < 4; ++i) {
        map.lines[i].properties.strength = 42.0F;
        map.lines[i + 4].properties.toughness = 3.0F;
    }
    const BakedObject baked = bakeCube(map);
    REQUIRE(baked.set.fragments.size() == 4);
    int low = 0, high = 0;
    for (const Bond& bond : baked.set.bonds) {
        if (std::abs(bond.centroid.z - 0.3F) < 0.1F) {
            ++low;
            CHECK(bond.strength == 42.0F);
            CHECK(bond.toughness == 50.0F);
        } else if (std::abs(bond.centroid.z - 0.6F) < 0.1F) {
            ++high;
            CHECK(bond.strength == 1e6F);
            CHECK(bond.toughness == 3.0F);
        }
    }
    CHECK(low == 1);
    CHECK(high == 1);
    checkFile(chartedCube(1, 3), planOf(map));
    // Half of a border says something: the mean along it.
    for (size_t i = 0; i < 8; ++i) map.lines[i].properties = {};
    for (size_t i = 0; i < 2; ++i) map.lines[i].properties.strength = 0.0F;
    const BakedObject mixed = bakeCube(map);
    for (const Bond& bond : mixed.set.bonds)
        if (std::abs(bond.centroid.z - 0.3F) < 0.1F)
            CHECK(bond.strength == doctest::Approx(5e5).epsilon(0.01));
}

TEST_CASE("every kind of pattern bakes into a file that passes the check") {
    for (const std::string text :
         {"voronoi:8:2", "wood:6", "grid:2x2", "grid:1x2:brick", "radial:4x2"}) {
        CAPTURE(text);
        checkFile(text[0] == 'v' ? torus(16, 8) : chartedCube(1, 3), patterns({text}));
    }
    checkFile(chartedCube(1, 3), patterns({"voronoi:3", "voronoi:8:4"}));
    const SurfaceMesh cube = chartedCube(1, 2);
    checkFile(together({cube, moved(cube, {1, 0.25F, 0.25F})}), patterns({"voronoi:5"}));
    checkFile(together({cube, moved(cube, {3, 0, 0})}), patterns({"voronoi:5"}));
}
