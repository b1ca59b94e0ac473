// SPDX-License-Identifier: MIT
#include "physics/mass_properties.h"

#include <doctest/doctest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "shapes.h"
#include "support/property.h"

using namespace sherd;

namespace {

MassProperties of(const test::Shape& shape) {
    return massProperties(shape.positions, shape.triangles);
}

void checkClose(const glm::dmat3& a, const glm::dmat3& b, double tolerance) {
    for (int c = 0; c < 3; ++c) {
        for (int r = 0; r < 3; ++r) CHECK(std::abs(a[c][r] - b[c][r]) <= tolerance);
    }
}

glm::dmat3 diagonal(double x, double y, double z) {
    glm::dmat3 m(0.0);
    m[0][0] = x;
    m[1][1] = y;
    m[2][2] = z;
    return m;
}

glm::dmat3 rebuilt(const PrincipalAxes& axes) {
    const glm::dmat3 rotation = glm::mat3_cast(glm::dquat(axes.orientation));
    return rotation * diagonal(axes.diagonal.x, axes.diagonal.y, axes.diagonal.z) *
           glm::transpose(rotation);
}

}  // namespace

TEST_CASE("nothing has no mass, and a flat mesh neither") {
    CHECK(massProperties({}, {}).volume == 0);
    CHECK(combine({}).volume == 0);
    const std::vector<glm::vec3> p = {{1, 1, 1}, {2, 1, 1}, {1, 2, 1}};
    const std::vector<std::array<uint32_t, 3>> t = {{0, 1, 2}, {0, 2, 1}};
    const MassProperties flat = massProperties(p, t);
    CHECK(flat.volume == 0);
    CHECK(std::isfinite(flat.center.x));
}

TEST_CASE("a box has the textbook volume, centre and inertia") {
    const MassProperties m = of(test::box({-1, 0, 2}, {3, 1, 5}));
    CHECK(m.volume == doctest::Approx(12));
    CHECK(glm::length(m.center - glm::dvec3(1, 0.5, 3.5)) < 1e-12);
    checkClose(m.inertia, diagonal(12.0 / 12 * (1 + 9), 12.0 / 12 * (16 + 9), 12.0 / 12 * (16 + 1)),
               1e-11);
}

TEST_CASE("a tetrahedron has the textbook products of inertia") {
    const MassProperties m = of(test::tetrahedron());
    CHECK(m.volume == doctest::Approx(1.0 / 6));
    CHECK(glm::length(m.center - glm::dvec3(0.25)) < 1e-15);
    // About the corner 1/60 and -1/120 of products, moved to the centre.
    CHECK(m.inertia[0][0] == doctest::Approx(1.0 / 80));
    CHECK(m.inertia[0][1] == doctest::Approx(1.0 / 480));
}

TEST_CASE("a mesh inside out has the negative volume and the same centre") {
    test::Shape shape = test::tetrahedron();
    for (auto& t : shape.triangles) std::swap(t[1], t[2]);
    const MassProperties m = of(shape);
    CHECK(m.volume == doctest::Approx(-1.0 / 6));
    CHECK(glm::length(m.center - glm::dvec3(0.25)) < 1e-15);
}

TEST_CASE("finer spheres come closer to the ball, quadratically") {
    const double ball = 4.0 / 3 * 3.14159265358979323846;
    double previous = 1;
    for (const uint32_t n : {8U, 16U, 32U, 64U}) {
        const MassProperties m = of(test::sphere(n, glm::vec3(0), 1));
        const double error = 1 - m.volume / ball;
        CHECK(error > 0);
        CHECK(error < previous / 3.5);
        CHECK(m.inertia[2][2] == doctest::Approx(0.4 * m.volume).epsilon(error));
        previous = error;
    }
}

TEST_CASE("far from the origin nothing is lost") {
    // Powers of two: the moved positions are exact, so any loss would be the integration's.
    const glm::vec3 far(65536, -131072, 32768);
    const MassProperties near = of(test::box(glm::vec3(0), {0.25F, 0.5F, 1}));
    const MassProperties moved = of(test::box(far, far + glm::vec3(0.25F, 0.5F, 1)));
    CHECK(moved.volume == doctest::Approx(near.volume).epsilon(1e-14));
    CHECK(glm::length(moved.center - near.center - glm::dvec3(far)) < 1e-10);
    checkClose(moved.inertia, near.inertia, 1e-14);
}

TEST_CASE("parts combined are the whole") {
    const std::vector<MassProperties> parts = {of(test::box({0, 0, 0}, {1, 2, 3})),
                                               of(test::box({1, 0, 0}, {4, 2, 1})),
                                               of(test::box({1, 0, 1}, {4, 2, 3}))};
    const MassProperties whole = of(test::box({0, 0, 0}, {4, 2, 3}));
    const MassProperties sum = combine(parts);
    CHECK(sum.volume == doctest::Approx(whole.volume));
    CHECK(glm::length(sum.center - whole.center) < 1e-14);
    checkClose(sum.inertia, whole.inertia, 1e-11);
}

TEST_CASE("a diagonal tensor keeps its axes") {
    for (const glm::dmat3& m : {diagonal(3, 2, 1), diagonal(1, 1, 1), diagonal(0, 0, 0)}) {
        const PrincipalAxes axes = principalAxes(m);
        CHECK(axes.diagonal == glm::dvec3(m[0][0], m[1][1], m[2][2]));
        CHECK(axes.orientation == glm::quat(1, 0, 0, 0));
    }
}

TEST_CASE("principal axes rebuild the tensor and are right-handed") {
    test::Random random(7);
    for (int i = 0; i < test::propertyCases(500); ++i) {
        glm::dquat q(random.in(-1, 1), random.in(-1, 1), random.in(-1, 1), random.in(-1, 1));
        q = glm::normalize(q);
        const glm::dmat3 r = glm::mat3_cast(q);
        // Some with two equal moments.
        const double a = random.in(0.1, 5);
        const double b = i % 3 == 0 ? a : random.in(0.1, 5);
        const glm::dmat3 m = r * diagonal(a, b, random.in(0.1, 5)) * glm::transpose(r);
        const PrincipalAxes axes = principalAxes(m);
        checkClose(rebuilt(axes), m, 5e-6);
        CHECK(glm::length(axes.orientation) == doctest::Approx(1).epsilon(1e-6));
        CHECK(axes.orientation.w >= 0);
    }
}

TEST_CASE("scale does not matter to the axes") {
    const test::Shape unit = test::tetrahedron();
    test::Shape tiny = unit;
    for (glm::vec3& p : tiny.positions) p *= 0x1p-20F;
    const PrincipalAxes a = principalAxes(of(unit).inertia);
    const PrincipalAxes b = principalAxes(of(tiny).inertia);
    CHECK(a.orientation == b.orientation);
    CHECK(b.diagonal.x == a.diagonal.x * 0x1p-100);
}
