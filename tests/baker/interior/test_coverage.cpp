// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <vector>

#include "interior/shapes.h"
#include "support/coverage.h"

using namespace sherd;
using namespace sherd::test;

namespace {

TriangleSoup soup(const Shape& shape) {
    return {shape.positions, shape.triangles};
}

}  // namespace

TEST_CASE("an empty or flat object has no points to cover") {
    CHECK(measureCoverage({}, {}).points == 0);
    Shape flat = box({0, 0, 0}, {1, 1, 0});
    CHECK(measureCoverage(soup(flat), {}, {.points = 10}).points == 0);
}

TEST_CASE("without fragments nothing is covered; the object covers itself once") {
    const Shape shape = torusShape(2, 0.5F, 24, 12);
    CHECK(measureCoverage(soup(shape), {}).noneShare() == 1);
    const std::vector<TriangleSoup> itself{soup(shape)};
    const Coverage coverage = measureCoverage(soup(shape), itself);
    CHECK(coverage.points == 20000);
    CHECK(coverage.none == 0);
    CHECK(coverage.several == 0);
}

TEST_CASE("two halves cover a box exactly, a gap and an overlap show with their share") {
    const Shape whole = box({0, 0, 0}, {1, 1, 1});
    const Shape left = box({0, 0, 0}, {0.5F, 1, 1}), right = box({0.5F, 0, 0}, {1, 1, 1});
    const Shape narrow = box({0.6F, 0, 0}, {1, 1, 1}), wide = box({0.4F, 0, 0}, {1, 1, 1});
    const std::vector<TriangleSoup> exact{soup(left), soup(right)}, gap{soup(left), soup(narrow)},
        overlap{soup(left), soup(wide)};
    CHECK(measureCoverage(soup(whole), exact).none == 0);
    CHECK(measureCoverage(soup(whole), exact).several == 0);
    CHECK(measureCoverage(soup(whole), gap).noneShare() == doctest::Approx(0.1).epsilon(0.05));
    CHECK(measureCoverage(soup(whole), overlap).severalShare() ==
          doctest::Approx(0.1).epsilon(0.05));
}

TEST_CASE("points within the skin of a face are skipped, and threads and seeds do as they say") {
    const Shape whole = box({0, 0, 0}, {1, 1, 1});
    const Shape small = box({0, 0, 0}, {1, 1, 0.9F});
    const std::vector<TriangleSoup> one{soup(small)};
    const Coverage thin = measureCoverage(soup(whole), one, {.skin = 0, .threads = 1});
    const Coverage thick = measureCoverage(soup(whole), one, {.skin = 0.03, .threads = 3});
    CHECK(thin.none > thick.none);
    CHECK(thin.points - thick.points == thin.none - thick.none);
    CHECK(measureCoverage(soup(whole), one, {.skin = 0, .threads = 3}).none == thin.none);
    CHECK(measureCoverage(soup(whole), one, {.seed = 2, .skin = 0}).none != thin.none);
}
