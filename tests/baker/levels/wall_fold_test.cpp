// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <map>
#include <set>

#include "levels/level_exposure.h"
#include "levels/wall_fold.h"

using namespace sherd;

namespace {

using Triangle = std::array<uint32_t, 3>;

/// A square wall: leaf 0 on one side, cut along one diagonal; on the other leaves 1 and 2, which
/// meet at the other diagonal.
struct SquareWall {
    SurfaceMesh mesh;
    SplitSurface surface;
    Components components;
    HiddenMesh hidden;
    std::array<std::vector<uint32_t>, 2> sides{{{0, 1}, {2, 3}}};
    PieceModel model{mesh, surface, components, hidden};

    explicit SquareWall(uint32_t exposedFrom) {
        components.levels = 2;
        hidden.positions = {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}};
        const auto add = [&](const Triangle& v, uint32_t leaf) {
            hidden.faces.push_back({v, leaf, exposedFrom, leaf, 0, true});
        };
        add({0, 1, 2}, 0);
        add({0, 2, 3}, 0);
        add({0, 3, 1}, 1);
        add({1, 3, 2}, 2);
    }

    /// The faces after folding.
    std::vector<HiddenMesh::Face> folded(const WallFold& fold) const {
        std::vector<HiddenMesh::Face> faces;
        for (uint32_t f = 0; f < hidden.faces.size(); ++f) {
            if (std::find(fold.dropped.begin(), fold.dropped.end(), f) != fold.dropped.end())
                continue;
            faces.push_back(hidden.faces[f]);
            if (std::find(fold.inner.begin(), fold.inner.end(), f) != fold.inner.end())
                faces.back().exposedFrom = fold.exposedFrom;
        }
        faces.insert(faces.end(), fold.added.begin(), fold.added.end());
        return faces;
    }
};

/// Of one leaf, how often more edges are used one way than the other.
std::map<std::pair<uint32_t, uint32_t>, int> borderOf(const std::vector<HiddenMesh::Face>& faces,
                                                      uint32_t leaf) {
    std::map<std::pair<uint32_t, uint32_t>, int> border;
    for (const HiddenMesh::Face& face : faces) {
        if (face.leaf != leaf) continue;
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t a = face.v[k], b = face.v[(k + 1) % 3];
            border[std::minmax(a, b)] += a < b ? 1 : -1;
        }
    }
    std::erase_if(border, [](const auto& use) { return use.second == 0; });
    return border;
}

}  // namespace

TEST_CASE("a folded wall has the same faces on both sides, and leaves end where they ended") {
    for (const uint32_t exposedFrom : {1U, kNotExposed}) {
        const SquareWall wall(exposedFrom);
        const auto fold = foldWall(wall.hidden.faces, wall.sides, wall.model);
        REQUIRE(fold.has_value());
        const std::vector<HiddenMesh::Face> faces = wall.folded(*fold);
        for (const uint32_t leaf : {0U, 1U, 2U})
            CHECK(borderOf(faces, leaf) == borderOf(wall.hidden.faces, leaf));
        std::multiset<std::pair<Triangle, uint32_t>> open;  // from the lowest corner on, and level
        for (const HiddenMesh::Face& face : faces) {
            Triangle v = face.v;
            std::rotate(v.begin(), std::min_element(v.begin(), v.end()), v.end());
            const auto back = open.find({{v[0], v[2], v[1]}, face.exposedFrom});
            if (back == open.end())
                open.insert({v, face.exposedFrom});
            else
                open.erase(back);
        }
        CHECK(open.empty());
    }
}

TEST_CASE("a side that one leaf has takes the other's faces without a fold") {
    const SquareWall wall(1);
    const auto fold = foldWall(wall.hidden.faces, wall.sides, wall.model);
    REQUIRE(fold.has_value());
    CHECK(fold->inner.empty());
    CHECK(fold->dropped == std::vector<uint32_t>{0, 1});
    for (const HiddenMesh::Face& face : fold->added) CHECK(face.leaf == 0);
}

TEST_CASE("of two sides with several leaves the largest leaf has the fold") {
    SquareWall wall(1);
    wall.hidden.faces[1].leaf = 3;
    wall.hidden.positions[1] = {1.5F, 0, 0};  // leaf 2 has more than any other
    const auto fold = foldWall(wall.hidden.faces, wall.sides, wall.model);
    REQUIRE(fold.has_value());
    CHECK(fold->inner.size() == 1);
    CHECK(fold->exposedFrom == 2);
    const std::vector<HiddenMesh::Face> faces = wall.folded(*fold);
    for (const uint32_t leaf : {0U, 1U, 2U, 3U})
        CHECK(borderOf(faces, leaf) == borderOf(wall.hidden.faces, leaf));
}

TEST_CASE("sides that do not end at the same edges are not folded") {
    SquareWall wall(1);
    wall.sides[1].pop_back();
    CHECK_FALSE(foldWall(wall.hidden.faces, wall.sides, wall.model).has_value());
}
