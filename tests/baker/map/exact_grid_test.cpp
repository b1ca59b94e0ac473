// SPDX-License-Identifier: MIT
#include "geometry/exact_grid.h"

#include <doctest/doctest.h>

#include <boost/multiprecision/cpp_int.hpp>
#include <limits>

#include "support/property.h"

using namespace sherd;
using boost::multiprecision::cpp_int;

namespace {

GridPoint randomPoint(test::Random& random, int32_t reach) {
    const auto pick = [&] {
        return static_cast<int32_t>(random.below(2 * static_cast<uint32_t>(reach) + 1)) - reach;
    };
    const int32_t u = pick();
    return {u, pick()};
}

cpp_int wideCross(GridPoint a, GridPoint b, GridPoint c, GridPoint d) {
    return (cpp_int(b.u) - a.u) * (cpp_int(d.v) - c.v) -
           (cpp_int(b.v) - a.v) * (cpp_int(d.u) - c.u);
}

}  // namespace

TEST_CASE("the widest cross product fits 64 bits") {
    const GridPoint low{-kGridLimit, -kGridLimit};
    const GridPoint high{kGridLimit, kGridLimit};
    const GridPoint left{-kGridLimit, kGridLimit};
    const GridPoint right{kGridLimit, -kGridLimit};
    CHECK(crossOf(low, high, left, right) == -(int64_t{1} << 57));
    CHECK(crossOf(low, high, right, left) == int64_t{1} << 57);
}

TEST_CASE("parallel lines have no crossing") {
    CHECK_FALSE(crossingParameter({0, 0}, {2, 2}, {1, 0}, {5, 4}));
    CHECK_FALSE(crossingParameter({0, 0}, {2, 2}, {1, 1}, {5, 5}));
}

TEST_CASE("equal parameters compare equal whatever their fractions") {
    CHECK(LineParameter{1, 2} == LineParameter{2, 4});
    CHECK(LineParameter{-1, 3} < LineParameter{0, 7});
    const int64_t huge = int64_t{1} << 57;
    CHECK(LineParameter{huge - 2, huge - 1} < LineParameter{huge - 1, huge});
}

TEST_CASE("a crossing on a grid point is found there, beside one it is not") {
    const auto t = crossingParameter({0, 0}, {4, 2}, {2, -5}, {2, 9});
    REQUIRE(t);
    CHECK(gridPointAt({0, 0}, {4, 2}, *t) == GridPoint{2, 1});
    const auto s = crossingParameter({0, 0}, {4, 2}, {1, -5}, {1, 9});
    REQUIRE(s);
    CHECK_FALSE(gridPointAt({0, 0}, {4, 2}, *s));
}

TEST_CASE("snapping refuses what is no number or beyond the limit") {
    CHECK(snapToGrid(8.0, -8.0) == GridPoint{kGridLimit, -kGridLimit});
    CHECK_FALSE(snapToGrid(std::nextafter(8.0, 9.0), 0));
    CHECK_FALSE(snapToGrid(0, std::numeric_limits<double>::quiet_NaN()));
    CHECK_FALSE(snapToGrid(-std::numeric_limits<double>::infinity(), 0));
}

TEST_CASE("sides of crossings agree with integers without limit") {
    const uint32_t seed = 20240611;
    CAPTURE(seed);
    test::Random random(seed);
    for (int i = 0; i < test::propertyCases(20000); ++i) {
        const int32_t reach = i % 2 == 0 ? kGridLimit : 3;
        const GridPoint a = randomPoint(random, reach);
        const GridPoint b = randomPoint(random, reach);
        const GridPoint c = randomPoint(random, reach);
        const GridPoint d = randomPoint(random, reach);
        const GridPoint p = randomPoint(random, reach);
        const GridPoint q = randomPoint(random, reach);
        const cpp_int den = wideCross(a, b, c, d);
        if (den == 0) continue;
        const cpp_int num = wideCross(a, c, c, d);
        const cpp_int side =
            (wideCross(p, q, p, a) * den + num * wideCross(p, q, a, b)) * den.sign();
        CHECK(sideOfCrossing(p, q, a, b, c, d) == side.sign());
        CHECK(sideOfCrossing(p, q, c, d, a, b) == side.sign());
    }
}
