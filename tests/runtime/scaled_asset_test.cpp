// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>

#include "sherd/runtime/asset.h"
#include "sherd/runtime/placement.h"
#include "support/box_fracture.h"

using namespace sherd;
using namespace sherd::test;

namespace {

std::shared_ptr<const Asset> box(const BoxFracture& recipe = {}) {
    return Asset::fromFractureSet(makeBoxFracture(recipe)).value();
}

}  // namespace

TEST_CASE("a scaled asset is the asset of a larger object of the same substance") {
    for (const float scale : {0.05F, 0.5F, 3.0F, 50.0F}) {
        CAPTURE(scale);
        const BoxFracture small{.size = {1, 2, 0.5F}, .level2 = {2, 1, 2}, .center = {0.3F, 1, 0}};
        BoxFracture large = small;
        large.size *= scale;
        large.center *= scale;
        const auto scaled = Asset::scaled(box(small), scale).value();
        const auto made = box(large);
        REQUIRE(scaled->fragmentCount() == made->fragmentCount());
        for (uint32_t f = 0; f < made->fragmentCount(); ++f) {
            const Fragment &x = scaled->fragment(f), &y = made->fragment(f);
            CHECK(x.mass == doctest::Approx(y.mass).epsilon(1e-5));
            CHECK(x.volume == doctest::Approx(y.volume).epsilon(1e-5));
            CHECK(scaled->breakEnergy(f) == doctest::Approx(made->breakEnergy(f)).epsilon(1e-4));
            for (int k = 0; k < 3; ++k) {
                CHECK(x.centerOfMass[k] == doctest::Approx(y.centerOfMass[k]).epsilon(1e-5));
                CHECK(x.inertiaDiagonal[k] == doctest::Approx(y.inertiaDiagonal[k]).epsilon(1e-4));
                CHECK(scaled->box(f).low[k] == doctest::Approx(made->box(f).low[k]).epsilon(1e-4));
            }
        }
        CHECK(scaled->diagonal() == doctest::Approx(made->diagonal()).epsilon(1e-5));
        REQUIRE(scaled->graph().bonds().size() == made->graph().bonds().size());
        CHECK(scaled->graph().bond(0).area ==
              doctest::Approx(made->graph().bond(0).area).epsilon(1e-4));
        CHECK(scaled->graph().bond(0).strength == made->graph().bond(0).strength);
    }
}

TEST_CASE("a scaled asset draws as its original, and keeps it alive") {
    auto original = box();
    const Asset* drawn = original.get();
    const auto scaled = Asset::scaled(original, 2).value();
    original.reset();
    CHECK(&scaled->original() == drawn);
    CHECK(scaled->scale() == 2);
    CHECK(&scaled->geometry() == &drawn->geometry());
    CHECK(scaled->drawRanges(3).data() == drawn->drawRanges(3).data());
    CHECK(scaled->set().geometry.positions.empty());
    CHECK(scaled->bakeHash() != drawn->bakeHash());
    // Again, and back.
    const auto twice = Asset::scaled(scaled, 2).value();
    CHECK(twice->scale() == 4);
    CHECK(&twice->original() == drawn);
    CHECK(Asset::scaled(twice, 0.25F).value().get() == drawn);
    // Denser: masses alone.
    const auto dense = Asset::scaled(scaled, 1, 3).value();
    CHECK(dense->density() == 3);
    CHECK(dense->fragment(1).mass == doctest::Approx(3 * scaled->fragment(1).mass));
    CHECK(dense->fragment(1).density == doctest::Approx(3 * scaled->fragment(1).density));
    CHECK(dense->breakEnergy(0) == scaled->breakEnergy(0));
    CHECK(dense->bakeHash() != scaled->bakeHash());
    CHECK_FALSE(Asset::scaled(scaled, 1, 0).has_value());
}

TEST_CASE("a scale that is none is an error, also one that leaves no mass or too much") {
    const auto asset = box();
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (const float scale : {0.0F, -1.0F, nan, HUGE_VALF}) {
        CAPTURE(scale);
        REQUIRE_FALSE(Asset::scaled(asset, scale).has_value());
        CHECK(Asset::scaled(asset, scale).error().code == ErrorCode::badArgument);
    }
    CHECK_FALSE(Asset::scaled(nullptr, 1).has_value());
    CHECK_FALSE(Asset::scaled(asset, 1e-20F).has_value());
    CHECK_FALSE(Asset::scaled(asset, 1e20F).has_value());
}

TEST_CASE("a level's matrix gives pose and scale, and is refused where it stretches") {
    const glm::mat4 turned = glm::rotate(glm::translate(glm::mat4(1), glm::vec3(1, 2, 3)), 0.7F,
                                         glm::normalize(glm::vec3(1, 1, 0)));
    const auto placed = placementOf(glm::scale(turned, glm::vec3(2.5F)));
    REQUIRE(placed.has_value());
    CHECK(placed->scale == doctest::Approx(2.5));
    CHECK(placed->pose.translation.y == doctest::Approx(2));
    const glm::vec3 point =
        placed->pose.translation + placed->pose.rotation * (placed->scale * glm::vec3(0, 0, 1));
    const glm::vec3 expected(glm::scale(turned, glm::vec3(2.5F)) * glm::vec4(0, 0, 1, 1));
    CHECK(glm::length(point - expected) < 1e-5F);

    const auto refused = [](const glm::mat4& matrix) {
        const auto placement = placementOf(matrix);
        return !placement && placement.error().code == ErrorCode::badArgument;
    };
    CHECK(refused(glm::scale(turned, glm::vec3(1, 1, 1.01F))));
    CHECK(refused(glm::scale(turned, glm::vec3(-1, 1, 1))));
    CHECK(refused(glm::mat4(0)));
    glm::mat4 sheared(1);
    sheared[1].x = 0.1F;
    CHECK(refused(sheared));
    glm::mat4 projected(1);
    projected[2].w = 1;
    CHECK(refused(projected));
    glm::mat4 broken(1);
    broken[3].x = std::numeric_limits<float>::quiet_NaN();
    CHECK(refused(broken));
}

TEST_CASE("assets come from wherever the game reads its files") {
    FileReader reader;
    reader.read = [](void* user, const char* path, std::vector<uint8_t>& bytes) {
        ++*static_cast<int*>(user);
        if (std::string(path) != "pak:/vase.glb") return false;
        bytes = {'g', 'l', 'T', 'F'};
        return true;
    };
    int reads = 0;
    reader.user = &reads;
    const auto missing = loadAssets(reader, "pak:/no.glb");
    REQUIRE_FALSE(missing.has_value());
    CHECK(missing.error().code == ErrorCode::fileNotFound);
    const auto truncated = loadAssets(reader, "pak:/vase.glb");
    REQUIRE_FALSE(truncated.has_value());
    CHECK(truncated.error().where.find("pak:/vase.glb") == 0);
    CHECK(reads == 2);
    CHECK_FALSE(loadAssets(FileReader{}, "pak:/vase.glb").has_value());
}
