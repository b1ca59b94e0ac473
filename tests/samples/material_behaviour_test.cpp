// SPDX-License-Identifier: MIT
// What things of real substances do, with presets and no tuning.
#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "impact/bullet_world.h"
#include "sherd/formats/glb_read.h"
#include "sherd/runtime/material.h"

using namespace sherd;
using namespace sherd::test;

namespace {

/// A sample made of some substance throughout.
std::shared_ptr<const Asset> sampleOf(const std::string& name, const char* material,
                                      float density) {
    auto sets = readFractureSets(std::filesystem::path(SHERD_DEMO "/" + name + "_baked.glb"));
    REQUIRE(sets.has_value());
    FractureSet& set = sets->front();
    for (Fragment& fragment : set.fragments) {
        const float scale = density / fragment.density;
        fragment.material = material;
        fragment.mass *= scale;
        fragment.inertiaDiagonal *= scale;
        fragment.density = density;
    }
    applyMaterials(set);
    return Asset::fromFractureSet(std::move(set)).value();
}

struct Outcome {
    uint32_t bodies = 0;
    uint32_t broken = 0;  ///< bonds
    uint32_t all = 0;
};

/// After a fall on stone from a height, metres, below its lowest point.
Outcome drop(const std::shared_ptr<const Asset>& asset, float height) {
    BulletWorld bullet(btVector3(0, -9.81F, 0));
    bullet.addGround(0);
    DestructionWorld destruction(bullet.world);
    const float bottom = asset->box(0).low.y;
    RigidPose pose = at(0, height - bottom, 0);
    const ObjectId object = destruction.spawn(asset, pose).value();
    for (int i = 0; i < 480; ++i) bullet.step(1.0F / 240);
    Outcome outcome;
    outcome.bodies = destruction.bodyCount();
    outcome.all = uint32_t(asset->graph().bonds().size());
    for (uint32_t b = 0; b < outcome.all; ++b)
        outcome.broken += destruction.structure(object)->isBroken(b) ? 1 : 0;
    return outcome;
}

}  // namespace

TEST_CASE("a porcelain vase dropped on stone survives 5 cm, cracks at 50 cm, shatters at 2 m") {
    const auto vase = sampleOf("vase", "porcelain", 2400);
    const Outcome low = drop(vase, 0.05F), middle = drop(vase, 0.5F), high = drop(vase, 2);
    for (const Outcome& o : {low, middle, high})
        MESSAGE(o.bodies << " bodies, " << o.broken << " of " << o.all << " bonds broken; "
                         << vase->fragment(0).mass << " kg");
    CHECK(low.broken == 0);
    CHECK(middle.broken > 0);
    CHECK(middle.broken < high.broken);
    CHECK(high.bodies > 10);
}

namespace {

FractureSet plateOf(const char* material, const BoxFracture& recipe) {
    FractureSet set = makeBoxFracture(recipe);
    for (Fragment& fragment : set.fragments) fragment.material = material;
    return set;
}

/// What a ball of 5 kg that comes with 15 m/s has left 0.25 s later, m/s.
float speedBehind(FractureSet set) {
    applyMaterials(set);
    BulletWorld bullet;
    DestructionWorld destruction(bullet.world);
    const auto asset = Asset::fromFractureSet(std::move(set)).value();
    (void)destruction.spawn(asset, at(0, 0, 0)).value();
    btRigidBody& ball =
        bullet.addBall(0.1F, 5, btVector3(0.03F, 0.05F, -0.5F), btVector3(0, 0, 15));
    for (int i = 0; i < 120; ++i) bullet.step(1.0F / 480);
    MESSAGE(ball.getLinearVelocity().z() << " m/s left, " << destruction.bodyCount() << " bodies");
    return float(ball.getLinearVelocity().z());
}

}  // namespace

TEST_CASE("a heavy ball keeps its speed through a window, and loses it at an anchored wall") {
    const FractureSet window =
        plateOf("glass", {.size = {1, 1, 0.004F}, .level1 = {10, 10, 1}, .density = 2500});
    CHECK(speedBehind(window) > 0.9F * 15);

    FractureSet wall =
        plateOf("brick", {.size = {2, 2, 0.24F}, .level1 = {9, 25, 1}, .density = 1800});
    for (size_t f = 1; f < wall.fragments.size(); ++f) {
        const glm::vec3& middle = wall.fragments[f].centerOfMass;
        if (std::abs(middle.x) < 0.85F && std::abs(middle.y) < 0.95F) continue;  // along its rim
        Bond anchor;
        anchor.a = int32_t(f);
        anchor.area = 0.01F;
        anchor.centroid = middle;
        wall.bonds.push_back(anchor);
    }
    CHECK(speedBehind(wall) < 0.1F * 15);
}
