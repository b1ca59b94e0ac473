// SPDX-License-Identifier: MIT
// Lines drawn on one skin alone, carried through to the other.
#include <glm/geometric.hpp>

#include "solid/solid_bakes.h"
#include "support/plans.h"
#include "support/surface_meshes.h"

using namespace sherd;
using namespace sherd::test;

namespace {

/// A plate of 1 x 1 x 0.1, its front (z = 0.1) charted as the whole page, its other faces beside
/// it.
SurfaceMesh plate(int cells) {
    MeshMaker maker;
    const glm::vec3 size(1, 1, 0.1F);
    for (int face = 0; face < 6; ++face) {
        const int axis = (face / 2 + 2) % 3;
        const bool high = face % 2 == 0;
        const auto corner = [&](int s, int t) {
            const glm::vec2 uv(static_cast<float>(s) / cells, static_cast<float>(t) / cells);
            glm::vec3 p(0.0F);
            p[axis] = high ? size[axis] : 0.0F;
            p[(axis + 1) % 3] = uv.x * size[(axis + 1) % 3];
            p[(axis + 2) % 3] = uv.y * size[(axis + 2) % 3];
            return MeshMaker::Corner{p, uv + glm::vec2(1.25F * face, 0)};
        };
        for (int t = 0; t < cells; ++t) {
            for (int s = 0; s < cells; ++s) {
                const auto a = corner(s, t), b = corner(s + 1, t), c = corner(s + 1, t + 1),
                           d = corner(s, t + 1);
                high ? maker.quad(a, b, c, d) : maker.quad(a, d, c, b);
            }
        }
    }
    return maker.mesh();
}

FractureMap linesAt(const std::vector<double>& places, uint32_t level = 1) {
    FractureMap map;
    for (const double x : places) {
        map.lines.push_back({{{x, 0}, {x, 1}}, level, "upright"});
        map.lines.push_back({{{0, x}, {1, x}}, level, "level"});
    }
    return map;
}

/// Of all broken faces of all pieces of the deepest level.
double hiddenArea(const FractureSet& set) {
    double area = 0;
    for (const Primitive& primitive : set.geometry.primitives) {
        if (primitive.exposedFrom == 0) continue;
        for (uint32_t i = 0; i < primitive.indices.count; i += 3) {
            const auto at = [&](uint32_t k) {
                return glm::dvec3(
                    set.geometry.positions[set.geometry.indices[primitive.indices.first + i + k]]);
            };
            area += 0.5 * glm::length(glm::cross(at(1) - at(0), at(2) - at(0)));
        }
    }
    return area;
}

/// Without repeating the page on the other faces.
SolidJudge unwrapped(const SurfaceMesh& mesh, const FractureMap& map) {
    Recipe recipe = solidRecipe();
    recipe.wrap = PageWrap::none;
    return {mesh, planOf(map), recipe};
}

}  // namespace

TEST_CASE("a grid on the front of a plate alone cuts it into bars of its full thickness") {
    for (const int cells : {1, 5}) {
        CAPTURE(cells);
        const FractureSet set = unwrapped(plate(cells), linesAt({0.25, 0.5, 0.75})).check(16);
        // Six cuts of 1 x 0.1, seen from both sides.
        CHECK(hiddenArea(set) == doctest::Approx(1.2).epsilon(0.01));
        CHECK(set.bonds.size() == 24);
    }
}

TEST_CASE("so does one whose outline is drawn around the front") {
    const FractureSet set = unwrapped(plate(1), linesAt({0, 0.25, 0.5, 0.75, 1})).check(16);
    CHECK(hiddenArea(set) == doctest::Approx(1.2).epsilon(0.01));
}

TEST_CASE("a single line across the front, which parts nothing of the surface, halves the plate") {
    FractureMap map;
    map.lines.push_back({{{0.5, 0}, {0.5, 1}}, 1, "middle"});
    unwrapped(plate(1), map).check(2);
}

TEST_CASE("a circle on the front alone punches a plug out of the plate") {
    FractureMap map;
    map.lines.push_back({{}, 1, "circle"});
    for (int i = 0; i <= 40; ++i) {
        const double angle = 2 * M_PI * (i % 40) / 40;
        map.lines[0].points.emplace_back(0.5 + 0.3 * std::cos(angle), 0.5 + 0.3 * std::sin(angle));
    }
    unwrapped(plate(2), map).check(2);
}

TEST_CASE("deeper lines on the front alone divide the full pieces of the level before") {
    FractureMap map = linesAt({0.5});
    const FractureMap deeper = linesAt({0.25, 0.75}, 2);
    map.lines.insert(map.lines.end(), deeper.lines.begin(), deeper.lines.end());
    const FractureSet set = unwrapped(plate(2), map).check(16);
    CHECK(fragmentsAtLevel(set, 1).size() == 4);
}

TEST_CASE("a line that ends in the middle of the front is not carried") {
    FractureMap map;
    map.lines.push_back({{{0.5, 0}, {0.5, 1}}, 1, "middle"});
    map.lines.push_back({{{0.2, 0.2}, {0.2, 0.7}}, 1, "slit"});
    unwrapped(plate(1), map).check(2);
}
