// SPDX-License-Identifier: MIT
#include "sherd/runtime/asset.h"

#include <doctest/doctest.h>

#include <functional>
#include <limits>
#include <string>

#include "support/box_fracture.h"
#include "support/fractured_cube.h"

using namespace sherd;

namespace {

/// The error after one thing in a good set has been spoiled.
Error errorAfter(const std::function<void(FractureSet&)>& spoil) {
    FractureSet set = test::makeBoxFracture({.level2 = {2, 1, 1}});
    spoil(set);
    const auto asset = Asset::fromFractureSet(std::move(set));
    REQUIRE_FALSE(asset.has_value());
    CHECK(asset.error().code == ErrorCode::invalidData);
    CHECK_FALSE(asset.error().message.empty());
    return asset.error();
}

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

}  // namespace

TEST_CASE("an empty set is refused") {
    CHECK_FALSE(Asset::fromFractureSet(FractureSet{}).has_value());
}

TEST_CASE("a tree with a cycle, a stranger or a lost child is refused") {
    CHECK(errorAfter([](FractureSet& s) { s.fragments[0].parent = 3; }).where ==
          "/fragments/attributes/PARENT");
    errorAfter([](FractureSet& s) { s.fragments[1].children = {0, 1}; });
    errorAfter([](FractureSet& s) { s.fragments[1].children = {1, 1}; });
    errorAfter([](FractureSet& s) { s.fragments[0].children = {1, UINT32_MAX}; });
    errorAfter([](FractureSet& s) { s.fragments[0].children = {UINT32_MAX, 2}; });
    errorAfter([](FractureSet& s) { s.fragments[0].children.count -= 1; });
    errorAfter([](FractureSet& s) { s.fragments[2].children = s.fragments[1].children; });
    errorAfter([](FractureSet& s) { s.fragments[3].parent = 1; });
    errorAfter([](FractureSet& s) { s.fragments[9].level = 0; });
}

TEST_CASE("numbers that are not finite or not positive are refused, and the place is named") {
    CHECK(errorAfter([](FractureSet& s) { s.fragments[2].mass = kNan; }).where ==
          "/fragments/attributes/MASS");
    errorAfter([](FractureSet& s) { s.fragments[2].mass = 0; });
    errorAfter([](FractureSet& s) { s.fragments[2].mass = -1; });
    errorAfter([](FractureSet& s) { s.fragments[2].inertiaDiagonal.y = 0; });
    errorAfter([](FractureSet& s) { s.fragments[2].inertiaOrientation = {0, 0, 0, 0}; });
    errorAfter([](FractureSet& s) { s.fragments[2].centerOfMass.x = kNan; });
    errorAfter([](FractureSet& s) { s.fragments[2].friction = -1; });
    errorAfter([](FractureSet& s) { s.fragments[2].toughness = kNan; });
    errorAfter([](FractureSet& s) { s.hulls[1].margin = -1; });
    errorAfter([](FractureSet& s) { s.hullPoints[5].z = kNan; });
    errorAfter([](FractureSet& s) { s.bonds[0].area = kNan; });
    errorAfter([](FractureSet& s) { s.bonds[0].toughness = -1; });
    errorAfter([](FractureSet& s) { s.geometry.positions[0].x = kNan; });
}

TEST_CASE("masses that are sound each, but not together, are refused") {
    errorAfter([](FractureSet& s) {
        for (Fragment& f : s.fragments) f.mass = 3e38F;
        s.fragments[0].mass = 1e-38F;
    });
    errorAfter([](FractureSet& s) {
        for (Fragment& f : s.fragments) f.centerOfMass *= 1e30F;
    });
}

TEST_CASE("references that leave their tables are refused") {
    errorAfter([](FractureSet& s) { s.fragments[2].hulls = {0, 0}; });
    errorAfter([](FractureSet& s) { s.fragments[2].hulls = {UINT32_MAX, 1}; });
    errorAfter([](FractureSet& s) { s.hulls[0].points = {0, UINT32_MAX}; });
    errorAfter([](FractureSet& s) { s.hulls[0].points.count = 0; });
    errorAfter([](FractureSet& s) { s.bonds[0].a = 1000; });
    errorAfter([](FractureSet& s) { s.bonds[0].b = -2; });
    errorAfter([](FractureSet& s) { s.bonds[0].b = s.bonds[0].a; });
    errorAfter([](FractureSet& s) { s.geometry.indices[4] = 1000000; });
    errorAfter([](FractureSet& s) { s.geometry.primitives[0].material = 9; });
    errorAfter([](FractureSet& s) { s.geometry.primitives[0].indices.count += 30000; });
    errorAfter([](FractureSet& s) { s.geometry.attributes[0].values.pop_back(); });
    errorAfter([](FractureSet& s) { s.geometry.attributes[0].components = 0; });
    errorAfter([](FractureSet& s) { s.fragmentRanges.pop_back(); });
    errorAfter([](FractureSet& s) { s.fragmentRanges[3] = {UINT32_MAX, 3}; });
}

TEST_CASE("the intact object shows its outside only, a fragment its fresh faces too") {
    const auto asset = Asset::fromFractureSet(test::makeBoxFracture({.level2 = {2, 1, 1}})).value();
    REQUIRE(asset->drawRanges(0).size() == 1);
    CHECK(asset->drawRanges(0)[0].exposedFrom == 0);
    CHECK(asset->drawRanges(1).size() == 2);  // outside and the level 1 cuts
    CHECK(asset->drawRanges(9).size() == 3);  // and the level 2 cut
    for (uint32_t f = 0; f < asset->fragmentCount(); ++f) {
        uint32_t indices = 0;
        for (const DrawRange& range : asset->drawRanges(f)) indices += range.indices.count;
        CHECK(indices == 3 * fragmentTriangles(asset->set(), f).size());
    }
}

TEST_CASE("a bond counts where the two sides part, an anchor nowhere") {
    FractureSet set = test::makeBoxFracture({.level2 = {2, 1, 1}});
    Bond anchor = set.bonds[0];
    anchor.b = -1;
    anchor.area = 100;
    set.bonds.push_back(anchor);
    const auto asset = Asset::fromFractureSet(std::move(set)).value();
    CHECK(asset->breakEnergy(0) == doctest::Approx(150.0));
    CHECK(asset->breakEnergy(1) == doctest::Approx(12.5));
    CHECK(asset->breakEnergy(9) == 0);
}

TEST_CASE("a file that does not exist is an error that says so") {
    const auto assets = loadAssets(std::filesystem::path("/nonexistent/object.glb"));
    REQUIRE_FALSE(assets.has_value());
    CHECK(assets.error().code == ErrorCode::fileNotFound);
}

TEST_CASE("bytes that are no GLB, or an empty buffer, are an error") {
    CHECK_FALSE(loadAssets(std::span<const uint8_t>()).has_value());
    const std::vector<uint8_t> noise(100, 0x5A);
    CHECK_FALSE(loadAssets(std::span<const uint8_t>(noise)).has_value());
}

TEST_CASE("a file whose object stands in two places, or consists of two nodes, is one asset") {
    FractureSet set = test::makeFracturedCube();
    set.fragments[2].material = "oak";
    GltfDocument document = test::makeIntactDocument(set);
    document.json.insert(document.json.find("],\"meshes\""), R"(,{"mesh":0})");
    const NewMaterial inside{"inside"};
    for (const bool joined : {false, true}) {
        set.sameNodes = joined ? std::vector<int32_t>() : std::vector<int32_t>{1};
        set.joinedNodes = joined ? std::vector<int32_t>{1} : std::vector<int32_t>();
        const auto glb = attachFractureSets(document, {&set, 1}, {&inside, 1});
        REQUIRE(glb.has_value());
        const auto assets = loadAssets(std::span<const uint8_t>(*glb));
        REQUIRE(assets.has_value());
        REQUIRE(assets->size() == 1);
        const Asset& asset = *assets->front();
        CHECK(asset.set().node == 0);
        CHECK(asset.set().sameNodes == set.sameNodes);
        CHECK(asset.set().joinedNodes == set.joinedNodes);
        CHECK(asset.fragment(2).material == "oak");
        CHECK(asset.fragment(1).material.empty());
    }
}
