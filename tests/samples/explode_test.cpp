// SPDX-License-Identifier: MIT
#include "explode.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "camera.h"
#include "support/fractured_cube.h"

using namespace sherd;
using namespace sherd::samples;

namespace {

std::shared_ptr<const Asset> makeAsset(test::FracturedCubeOptions options) {
    auto asset = Asset::fromFractureSet(test::FracturedCube(std::move(options)).build());
    REQUIRE(asset.has_value());
    return *asset;
}

glm::vec3 center(const FragmentPose& piece) {
    return piece.pose.translation +
           piece.pose.rotation * piece.asset->fragment(piece.fragment).centerOfMass;
}

float lowest(const Asset& asset, const std::vector<FragmentPose>& pieces) {
    float low = 1e9F;
    for (const glm::vec3& p : shownPlaces(asset, pieces)) low = std::min(low, p.y);
    return low;
}

/// Share of the picture's half width and height the place is from its middle.
float offMiddle(const SceneFrame& frame, float aspect, const glm::vec3& p) {
    const glm::vec4 clip = viewProjection(frame, aspect) * glm::vec4(p, 1.0F);
    CHECK(clip.w > 0);
    return std::max(std::abs(clip.x / clip.w), std::abs(clip.y / clip.w));
}

}  // namespace

TEST_CASE("pulled apart by nothing, every level rests as in its scene") {
    test::FracturedCubeOptions options;
    options.restPose = {{1, 2, 3}, glm::angleAxis(0.5F, glm::vec3(0, 0, 1))};
    const auto asset = makeAsset(options);
    for (const uint32_t level : {0U, 1U, 2U}) {
        const std::vector<FragmentPose> pieces = pullApart(*asset, level, 0);
        CHECK(pieces.size() == fragmentsAtLevel(asset->set(), level).size());
        for (const FragmentPose& piece : pieces) {
            CHECK(piece.pose.translation == options.restPose.translation);
            CHECK(piece.pose.rotation == options.restPose.rotation);
        }
    }
}

TEST_CASE("the intact object stays where it is, however far pieces go") {
    const auto asset = makeAsset({});
    const std::vector<FragmentPose> pieces = pullApart(*asset, 0, 10);
    REQUIRE(pieces.size() == 1);
    CHECK(pieces[0].pose.translation == glm::vec3(0));
}

TEST_CASE("pieces move straight away from the middle, and never towards each other") {
    const auto asset = makeAsset({});
    const std::vector<FragmentPose> rest = pullApart(*asset, 2, 0);
    const std::vector<FragmentPose> apart = pullApart(*asset, 2, 0.8F);
    for (size_t i = 0; i < rest.size(); ++i) {
        CHECK(glm::length(center(apart[i])) > glm::length(center(rest[i])));
        for (size_t j = 0; j < i; ++j) {
            const float before = glm::distance(center(rest[i]), center(rest[j]));
            CHECK(glm::distance(center(apart[i]), center(apart[j])) > before);
        }
    }
}

TEST_CASE("an object turned in its scene is pulled apart along its own axes") {
    test::FracturedCubeOptions options;
    options.splits = {{2, 1, 1}};
    options.restPose.rotation = glm::angleAxis(glm::radians(90.0F), glm::vec3(0, 0, 1));
    const auto asset = makeAsset(options);
    for (const FragmentPose& piece : pullApart(*asset, 1, 1)) {
        CHECK(std::abs(piece.pose.translation.x) < 1e-6F);
        CHECK(std::abs(piece.pose.translation.y) > 0.1F);
    }
}

TEST_CASE("set down, the lowest piece touches the floor and the gaps stay") {
    const auto asset = makeAsset({});
    std::vector<FragmentPose> pieces = pullApart(*asset, 2, 0.8F);
    const glm::vec3 gap = center(pieces[0]) - center(pieces[5]);
    setDown(*asset, pieces);
    CHECK(std::abs(lowest(*asset, pieces)) < 1e-6F);
    CHECK(glm::distance(center(pieces[0]) - center(pieces[5]), gap) < 1e-6F);
}

TEST_CASE("the camera sees every place and stands no farther than needed") {
    test::FracturedCubeOptions flat;
    flat.size = {0.2F, 1.0F, 2.0F};
    const auto asset = makeAsset(flat);
    std::vector<FragmentPose> pieces = pullApart(*asset, 2, 0.8F);
    setDown(*asset, pieces);
    const std::vector<glm::vec3> places = shownPlaces(*asset, pieces);
    for (const float turn : {-170.0F, -20.0F, 0.0F, 90.0F}) {
        for (const float aspect : {0.5F, 1.0F, 3.0F}) {
            CameraOptions options;
            options.turn = turn;
            options.aspect = aspect;
            const SceneFrame frame = frameAround(places, options);
            float most = 0;
            for (const glm::vec3& p : places) most = std::max(most, offMiddle(frame, aspect, p));
            CHECK(most < 1);
            CHECK(most > 0.9F);
        }
    }
}
