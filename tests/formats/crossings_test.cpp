// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <cfloat>
#include <cmath>

#include "crossing_triangles.h"
#include "exact_sum.h"
#include "support/fractured_cube.h"
#include "support/property.h"
#include "thin_parts.h"

using namespace sherd;
using namespace sherd::test;

namespace {

using Triangle = std::array<glm::vec3, 3>;

bool meet(const Triangle& a, const Triangle& b) {
    const bool result = insidesMeet(a, b);
    CHECK(insidesMeet(b, a) == result);
    return result;
}

int signOf(std::initializer_list<std::array<float, 3>> products) {
    ExactSum sum;
    for (const auto& [a, b, c] : products) sum.add(1, a, b, c);
    return sum.sign();
}

}  // namespace

TEST_CASE("a sum of products is exact from the smallest float to the largest") {
    const float tiny = FLT_TRUE_MIN, huge = FLT_MAX;
    CHECK(ExactSum().sign() == 0);
    CHECK(signOf({{0.0F, huge, huge}, {-0.0F, 1, 1}}) == 0);
    CHECK(signOf({{tiny, tiny, tiny}}) == 1);
    CHECK(signOf({{-tiny, tiny, tiny}}) == -1);
    CHECK(signOf({{huge, huge, huge}, {-huge, huge, huge}}) == 0);
    CHECK(signOf({{huge, huge, huge}, {-huge, huge, huge}, {tiny, tiny, -tiny}}) == -1);
    CHECK(signOf({{-huge, huge, huge}, {tiny, 1, 1}, {huge, huge, huge}}) == 1);
    ExactSum many;
    for (int i = 0; i < 1000; ++i) many.add(-1, huge, huge, huge);
    CHECK(many.sign() == -1);
    for (int i = 0; i < 1000; ++i) many.add(1, huge, -huge, -huge);
    CHECK(many.sign() == 0);
}

TEST_CASE("sums of whole numbers have the sign that integers give") {
    for (const uint32_t seed : propertySeeds(1, 50)) {
        CAPTURE(seed);
        Random random(seed);
        for (int i = 0; i < 200; ++i) {
            ExactSum sum;
            int64_t expected = 0;
            for (uint32_t k = random.below(6); k > 0; --k) {
                std::array<int64_t, 3> f{};
                for (int64_t& x : f) x = static_cast<int64_t>(random.below(2000)) - 1000;
                const int sign = random.oneIn(2) ? 1 : -1;
                sum.add(sign, static_cast<float>(f[0]), static_cast<float>(f[1]),
                        static_cast<float>(f[2]));
                expected += sign * f[0] * f[1] * f[2];
                if (random.oneIn(2)) {  // and away again
                    sum.add(-sign, static_cast<float>(f[2]), static_cast<float>(f[0]),
                            static_cast<float>(f[1]));
                    expected -= sign * f[0] * f[1] * f[2];
                }
            }
            CHECK(sum.sign() == (expected > 0 ? 1 : (expected < 0 ? -1 : 0)));
        }
    }
}

TEST_CASE("triangles that only touch, or have no area, share no inside") {
    const Triangle t = {glm::vec3(0, 0, 0), {4, 0, 0}, {0, 4, 0}};
    CHECK_FALSE(meet(t, {glm::vec3(1, 1, 0), {1, 1, 2}, {2, 1, 2}}));
    CHECK_FALSE(meet(t, {glm::vec3(1, 1, 0), {2, 1, 0}, {1, 1, 2}}));
    CHECK_FALSE(meet(t, {glm::vec3(2, -1, 0), {2, 0, 1}, {2, 0, -1}}));
    CHECK_FALSE(meet(t, {glm::vec3(4, 0, 0), {0, 0, 0}, {0, -4, 0}}));
    CHECK_FALSE(meet(t, {glm::vec3(0, 0, 1), {4, 0, 1}, {0, 4, 1}}));
    CHECK_FALSE(meet(t, {glm::vec3(1, 1, -1), {1, 1, 1}, {1, 1, 3}}));
    CHECK_FALSE(meet(t, {glm::vec3(1, 1, 0), {1, 1, 0}, {2, 1, 0}}));
    const Triangle line = {glm::vec3(0, 0, 0), {1, 0, 0}, {2, 0, 0}};
    CHECK_FALSE(meet(line, line));
}

TEST_CASE("triangles that cross or overlap share inside points, by however little") {
    const Triangle t = {glm::vec3(0, 0, 0), {4, 0, 0}, {0, 4, 0}};
    CHECK(meet(t, {glm::vec3(1, 1, -FLT_TRUE_MIN), {1, 1, 2}, {2, 1, 2}}));
    CHECK_FALSE(meet(t, {glm::vec3(1, 1, FLT_TRUE_MIN), {1, 1, 2}, {2, 1, 2}}));
    CHECK(meet(t, {glm::vec3(4, 0, 0), {0, 0, 0}, {1, 1, 0}}));
    CHECK(meet(t, {glm::vec3(0, 0, 0), {2, 2, -1}, {2, 2, 1}}));
    CHECK(meet(t, t));
    const float one = std::nextafter(1.0F, 0.0F);
    CHECK_FALSE(meet(t, {glm::vec3(3, 1, -1), {3, 1, 1}, {5, 3, 0}}));
    CHECK(meet(t, {glm::vec3(3, one, -1), {3, one, 1}, {5, 3, 0}}));
}

TEST_CASE("the count of crossings ends where triangles are piled up, and says so") {
    const std::vector<glm::vec3> positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    const std::vector<std::array<uint32_t, 3>> same(40, {0, 1, 2});
    CHECK(countCrossings(positions, same).pairs == 40 * 39 / 2);
    CHECK(countCrossings(positions, same).complete);
    // One behind the other, aslant, so that each has to be tested against every other.
    std::vector<glm::vec3> slices;
    std::vector<std::array<uint32_t, 3>> many;
    many.reserve(900);
    for (uint32_t i = 0; i < 900; ++i) {
        const float size = 1 + 1e-4F * float(i);
        slices.insert(slices.end(), {{size, 0, 0}, {0, size, 0}, {0, 0, size}});
        many.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    CHECK_FALSE(countCrossings(slices, many).complete);
    CHECK(countCrossings(positions, {}).pairs == 0);
}

TEST_CASE("a box is as thick as its thinnest side") {
    FracturedCubeOptions options;
    options.size = {1.0F, 2.0F, 0.3F};
    const FractureSet set = makeFracturedCube(options);
    const auto thickness = [&set](uint32_t f) {
        return thinnestPart(set.geometry.positions, fragmentTriangles(set, f), 200, 0.1, f);
    };
    CHECK(thickness(0) == doctest::Approx(0.3));
    CHECK(thickness(1) == doctest::Approx(0.3));
    CHECK(thickness(3) == doctest::Approx(0.15));
    CHECK(thinnestPart(set.geometry.positions, {}, 200, 0.1, 1) == 0);
    CHECK(thinnestPart(set.geometry.positions, {{0, 0, 1}}, 200, 0.1, 1) == 0);
}
