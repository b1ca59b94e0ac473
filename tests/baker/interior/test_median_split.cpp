// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <functional>

#include "interior/median_split.h"
#include "support/property.h"

using namespace sherd;
using namespace sherd::test;

namespace {

std::vector<SplitMember> membersAt(size_t count, const std::function<glm::vec3(size_t)>& place) {
    std::vector<SplitMember> members;
    members.reserve(count);
    for (size_t i = 0; i < count; ++i) members.push_back({place(i), static_cast<uint32_t>(i)});
    return members;
}

/// The numbers of those on the left after sorting them all, and after the split.
void checkAsSorted(std::vector<SplitMember> members, size_t left, int axis) {
    std::vector<SplitMember> sorted = members, scratch;
    std::sort(sorted.begin(), sorted.end(), [axis](const SplitMember& a, const SplitMember& b) {
        const float x = a.middle[axis], y = b.middle[axis];
        return x != y ? x < y : a.triangle < b.triangle;
    });
    medianSplit(members, left, scratch);
    const auto numbersOf = [](const std::vector<SplitMember>& list, size_t first, size_t last) {
        std::vector<uint32_t> numbers;
        numbers.reserve(last - first);
        for (size_t i = first; i < last; ++i) numbers.push_back(list[i].triangle);
        std::sort(numbers.begin(), numbers.end());
        return numbers;
    };
    CHECK(numbersOf(members, 0, left) == numbersOf(sorted, 0, left));
    CHECK(numbersOf(members, left, members.size()) == numbersOf(sorted, left, sorted.size()));
}

}  // namespace

TEST_CASE("nothing is split from nothing, and none or all of some from the rest") {
    std::vector<SplitMember> none, scratch;
    medianSplit(none, 0, scratch);
    for (const size_t left : {0U, 3U})
        checkAsSorted(membersAt(3, [](size_t i) { return glm::vec3(3.0F - float(i)); }), left, 0);
}

TEST_CASE("members all in one place are split by their numbers") {
    for (const size_t count : {2U, 63U, 1000U})
        checkAsSorted(membersAt(count, [](size_t) { return glm::vec3(0.3F); }), count / 2, 0);
}

TEST_CASE("members nearer to each other than any slice is wide are split by their places") {
    // All but one lie in the first slice, a few bits apart.
    const auto place = [](size_t i) {
        return glm::vec3(i == 0 ? 1.0F : 1e-9F * float(i * 7919 % 500), 0, 0);
    };
    checkAsSorted(membersAt(500, place), 250, 0);
}

TEST_CASE("members so near that slices would have no width are split by their places") {
    const auto place = [](size_t i) { return glm::vec3(0, 1e-40F * float(i * 37 % 100), 0); };
    checkAsSorted(membersAt(100, place), 40, 1);
}

TEST_CASE("a split puts those on the left that sorting would, wherever they lie") {
    for (const uint32_t seed : propertySeeds(1, 200)) {
        CAPTURE(seed);
        Random random(seed);
        const size_t count = 2 + random.below(3000);
        const int axis = static_cast<int>(random.below(3));
        const uint32_t steps = 1 + random.below(5000);  // few: many are equal
        const auto place = [&](size_t) {
            glm::vec3 p(0.0F);
            for (int k = 0; k < 3; ++k)
                p[k] = (k == axis ? 1.0F : 0.01F) * float(random.below(steps)) / float(steps);
            return p;
        };
        std::vector<SplitMember> members = membersAt(count, place);
        members[0].middle[axis] = 2;  // the longest side
        checkAsSorted(members, random.below(static_cast<uint32_t>(count)), axis);
    }
}
