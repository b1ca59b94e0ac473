// SPDX-License-Identifier: MIT
#include "sherd/runtime/damage.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "sherd/runtime/asset.h"
#include "support/box_fracture.h"

using namespace sherd;

TEST_CASE("a contact that does not approach has no energy, however hard it presses") {
    CHECK(contactEnergy({1000.0F, 0.0F, 5.0F}) == 0);
    CHECK(contactEnergy({1000.0F, -3.0F, 5.0F}) == 0);
    CHECK(contactEnergy({10.0F, 3.0F, 0.0F}) == 0);
    CHECK(contactEnergy({10.0F, std::nanf(""), 5.0F}) == 0);
}

TEST_CASE("a plastic impact brings all of 1/2 m v^2, a bounce no more than that") {
    CHECK(contactEnergy({20.0F, 4.0F, 5.0F}) == doctest::Approx(40));
    CHECK(contactEnergy({35.0F, 4.0F, 5.0F}) == doctest::Approx(40));
}

TEST_CASE("a contact that stopped only part of the approach brings only that part") {
    // From 4 m/s to 2 m/s: 5 kg lose 30 J.
    CHECK(contactEnergy({10.0F, 4.0F, 5.0F}) == doctest::Approx(30));
    CHECK(contactEnergy({0.0F, 4.0F, 5.0F}) == 0);
}

TEST_CASE("scales multiply and the stricter minimum and level count when options are combined") {
    DamageOptions world;
    world.toughnessScale = 2;
    world.strengthScale = 3;
    world.minimumImpulse = 0.5F;
    world.minimumEnergy = 0.1F;
    world.maxLevel = 3;
    DamageOptions object;
    object.toughnessScale = 3;
    object.strengthScale = 0.5F;
    object.levelScale = 0.25F;
    object.minimumImpulse = 0.2F;
    object.minimumEnergy = 0.4F;
    object.immunity = 2;
    object.maxLevel = 1;
    const DamageOptions both = combine(world, object);
    CHECK(both.toughnessScale == 6.0F);
    CHECK(both.strengthScale == 1.5F);
    CHECK(both.levelScale == 0.25F);
    CHECK(both.minimumImpulse == 0.5F);
    CHECK(both.minimumEnergy == 0.4F);
    CHECK(both.immunity == 2);
    CHECK(both.maxLevel == 1);
}
