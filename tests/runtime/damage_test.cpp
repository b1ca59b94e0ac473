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
    const DamageOptions both = combine({2.0F, 0.5F, 0.1F, 3}, {3.0F, 0.2F, 0.4F, 1});
    CHECK(both.toughnessScale == 6.0F);
    CHECK(both.minimumImpulse == 0.5F);
    CHECK(both.minimumEnergy == 0.4F);
    CHECK(both.maxLevel == 1);
}

TEST_CASE("a piece breaks exactly from the energy of its bonds on") {
    const auto asset = Asset::fromFractureSet(test::makeBoxFracture()).value();
    const float threshold = breakThreshold(*asset, 0, {});
    CHECK(threshold == doctest::Approx(3 * 50.0));  // three cuts of 1 m^2
    CHECK(breaks(*asset, 0, threshold, 10, {}));
    CHECK_FALSE(breaks(*asset, 0, std::nextafter(threshold, 0.0F), 10, {}));
    CHECK_FALSE(breaks(*asset, 0, std::nanf(""), 10, {}));

    DamageOptions tough;
    tough.toughnessScale = 2;
    CHECK(breakThreshold(*asset, 0, tough) == doctest::Approx(2 * threshold));
    DamageOptions heavyHandedOnly;
    heavyHandedOnly.minimumImpulse = 20;
    CHECK_FALSE(breaks(*asset, 0, 1e6F, 10, heavyHandedOnly));
}

TEST_CASE("a leaf, and a piece at the deepest level allowed, never breaks") {
    const auto asset = Asset::fromFractureSet(test::makeBoxFracture()).value();
    CHECK_FALSE(breaks(*asset, 1, 1e30F, 1e30F, {}));
    DamageOptions unbreakable;
    unbreakable.maxLevel = 0;
    CHECK_FALSE(breaks(*asset, 0, 1e30F, 1e30F, unbreakable));
}
