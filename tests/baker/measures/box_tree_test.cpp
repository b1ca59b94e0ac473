// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <limits>
#include <set>

#include "geometry/box_tree.h"
#include "support/property.h"

using namespace sherd;
using namespace sherd::test;

namespace {

std::vector<FloatBox> randomBoxes(Random& random, uint32_t count) {
    std::vector<FloatBox> boxes;
    const bool coarse = random.oneIn(2);  // many in one place
    for (uint32_t i = 0; i < count; ++i) {
        FloatBox box;
        for (int k = 0; k < 3; ++k) {
            const double at = coarse ? random.below(3) : random.in(-5, 5);
            box.low[k] = static_cast<float>(at);
            box.high[k] = static_cast<float>(at + (random.oneIn(3) ? 0 : random.in(0, 1)));
        }
        boxes.push_back(box);
    }
    return boxes;
}

using Pairs = std::set<std::pair<uint32_t, uint32_t>>;

Pairs pairsOf(const BoxTree& tree) {
    Pairs pairs;
    for (size_t leaf = 0; leaf < tree.leafCount(); ++leaf)
        tree.pairsOf(leaf, SIZE_MAX - 1, [&](uint32_t a, uint32_t b) {
            CHECK(pairs.insert(std::minmax(a, b)).second);
        });
    return pairs;
}

}  // namespace

TEST_CASE("a tree of no boxes answers nothing, a tree of one finds it") {
    const BoxTree none({});
    CHECK(none.leafCount() == 0);
    CHECK_FALSE(none.any([](const FloatBox&) { return true; }, [](uint32_t) { return true; }));
    const BoxTree one({FloatBox{glm::vec3(1), glm::vec3(2)}});
    CHECK(pairsOf(one).empty());
    int visits = 0;
    one.along(glm::dvec3(0), glm::dvec3(1), 10, [&](uint32_t i, double&) {
        CHECK(i == 0);
        ++visits;
    });
    one.along(glm::dvec3(0), glm::dvec3(-1), 10, [&](uint32_t, double&) { ++visits; });
    one.along(glm::dvec3(0), glm::dvec3(1), 0.5, [&](uint32_t, double&) { ++visits; });
    CHECK(visits == 1);
}

TEST_CASE("every pair of boxes that meet is found once") {
    for (const uint32_t seed : propertySeeds(1, 60)) {
        CAPTURE(seed);
        Random random(seed);
        const std::vector<FloatBox> boxes = randomBoxes(random, random.below(120));
        Pairs expected;
        for (uint32_t a = 0; a < boxes.size(); ++a)
            for (uint32_t b = a + 1; b < boxes.size(); ++b)
                if (boxes[a].meets(boxes[b])) expected.insert({a, b});
        CHECK(pairsOf(BoxTree(boxes)) == expected);
    }
}

TEST_CASE("the search for pairs ends beyond its limit and says how far it went") {
    const BoxTree tree(std::vector<FloatBox>(1000, FloatBox{glm::vec3(0), glm::vec3(1)}));
    size_t found = 0;
    const size_t looked = tree.pairsOf(0, 100, [&](uint32_t, uint32_t) { ++found; });
    CHECK(looked > 100);
    CHECK(looked < 140);
    CHECK(found == looked);
}

TEST_CASE("a ray meets every box on its way before its limit") {
    for (const uint32_t seed : propertySeeds(1, 60)) {
        CAPTURE(seed);
        Random random(seed);
        const std::vector<FloatBox> boxes = randomBoxes(random, 1 + random.below(120));
        const BoxTree tree(boxes);
        for (int i = 0; i < 20; ++i) {
            const glm::dvec3 from(random.in(-6, 6), random.in(-6, 6), random.in(-6, 6));
            glm::dvec3 along(random.in(-1, 1), random.in(-1, 1), random.in(-1, 1));
            if (random.oneIn(3)) along[static_cast<int>(random.below(3))] = 0;
            std::set<uint32_t> visited;
            tree.along(from, along, 6, [&](uint32_t b, double&) { visited.insert(b); });
            for (uint32_t b = 0; b < boxes.size(); ++b) {
                // A point of the ray well inside the box.
                const glm::dvec3 middle(0.5F * (boxes[b].low + boxes[b].high));
                for (int k = 0; k < 3; ++k) {
                    if (along[k] == 0) continue;
                    const double t = (middle[k] - from[k]) / along[k];
                    if (t < 0 || t >= 6) continue;
                    const glm::dvec3 p = from + along * t;
                    bool in = true;
                    for (int j = 0; j < 3; ++j)
                        in = in && p[j] > boxes[b].low[j] + 1e-6 && p[j] < boxes[b].high[j] - 1e-6;
                    if (in) CHECK(visited.count(b) == 1);
                }
            }
        }
    }
}
