// SPDX-License-Identifier: MIT
#include "interior/ball_nodes.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "interior/median_split.h"
#include "parallel/parallel_for.h"

namespace sherd {
namespace {

constexpr float kNowhere = 1e18F;  // where the boxes and triangles are that are none
constexpr float kUnbounded = 1e30F;
constexpr uint32_t kWidth = BallNodes::kWidth;
constexpr size_t kNodeGrain = 4096;  // triangles

struct Box {
    glm::vec3 low{kUnbounded}, high{-kUnbounded};
};
/// Some triangles: the box around them, and the sum of their normals times twice their areas.
struct Patch {
    Box box;
    glm::vec3 normal{0};

    void add(const Patch& other) {
        box = {glm::min(box.low, other.box.low), glm::max(box.high, other.box.high)};
        normal += other.normal;
    }
};
struct Slab {
    glm::vec3 normal{1, 0, 0};
    float low = -kUnbounded, high = kUnbounded;
};
/// Of the order of the triangles, and where its nodes go.
struct Subtree {
    uint32_t first = 0, last = 0;
    uint32_t root = 0;
    uint32_t count() const { return last - first; }
};

void setLane(LanesOfPoints& vectors, size_t lane, const glm::vec3& v) {
    vectors[0].at[lane] = v.x;
    vectors[1].at[lane] = v.y;
    vectors[2].at[lane] = v.z;
}

Lanes row(const glm::vec3& v, float fourth) {
    return {{v.x, v.y, v.z, fourth}};
}

uint32_t leavesOf(uint32_t triangles) {
    return (triangles + kWidth - 1) / kWidth;
}

/// Quarters, of whole leaves but for the last.
std::array<uint32_t, kWidth> partsOf(uint32_t triangles) {
    const auto half = [](uint32_t count) {
        return std::min(count, kWidth * ((leavesOf(count) + 1) / 2));
    };
    const uint32_t left = half(triangles), right = triangles - left;
    return {half(left), left - half(left), half(right), right - half(right)};
}

/// Nodes over so many triangles: the shape is known beforehand, so parts can be built at once.
uint32_t nodesOf(uint32_t triangles) {
    if (triangles <= kWidth) return 0;
    uint32_t count = 1;
    for (const uint32_t part : partsOf(triangles)) count += nodesOf(part);
    return count;
}

using Members = std::span<const SplitMember>;
using Scratch = std::vector<SplitMember>;

class Builder {
  public:
    Builder(std::span<const glm::vec3> positions,
            std::span<const std::array<uint32_t, 3>> triangles, unsigned threads)
        : positions_(positions),
          triangles_(triangles),
          threads_(threads),
          order_(triangles.size()) {
        parallelRuns(order_.size(), kNodeGrain, threads, [&](size_t first, size_t last) {
            for (size_t t = first; t < last; ++t) {
                const auto [a, b, c] = corners(static_cast<uint32_t>(t));
                order_[t] = {(a + b + c) / 3.0F, static_cast<uint32_t>(t)};
            }
        });
    }

    BallNodes run(std::span<const uint32_t> opposite) {
        const auto count = static_cast<uint32_t>(triangles_.size());
        if (count == 0) return {};
        result_.nodes.resize(nodesOf(count));
        patches_.resize(result_.nodes.size());
        result_.root = count <= kWidth ? BallNodes::kLeaf : 0;
        if (count > kWidth) build({0, count, 0});
        result_.leaves.resize(leavesOf(count));
        result_.triangles.resize(count);
        result_.fans.resize(count);
        result_.numbers.resize(count);
        std::vector<uint32_t> place(count);
        const auto forRuns = [&](const auto& take) {
            parallelRuns(result_.leaves.size(), kNodeGrain / kWidth, threads_,
                         [&](size_t first, size_t last) {
                             for (size_t i = kWidth * first; i < kWidth * last; ++i) take(i);
                         });
        };
        forRuns([&](size_t i) {
            takeTriangle(i);
            if (i < count) place[order_[i].triangle] = static_cast<uint32_t>(i);
        });
        forRuns([&](size_t i) {
            if (i < count) takeFan(static_cast<uint32_t>(i), opposite, place);
        });
        return std::move(result_);
    }

  private:
    std::array<glm::vec3, 3> corners(uint32_t triangle) const {
        const auto& [a, b, c] = triangles_[triangle];
        return {positions_[a], positions_[b], positions_[c]};
    }
    std::span<SplitMember> part(uint32_t first, uint32_t last) {
        return std::span(order_).subspan(first, last - first);
    }

    void build(const Subtree& whole);
    std::array<Subtree, kWidth> divide(const Subtree& at, unsigned threads, Scratch& scratch);
    void buildBelow(const Subtree& at, Scratch& scratch);
    void describe(const Subtree& at);
    Patch patchOf(Members members) const;
    Slab slabOf(Members members, const glm::vec3& normal) const;
    void takeTriangle(size_t i);
    void takeFan(uint32_t i, std::span<const uint32_t> opposite, std::span<const uint32_t> place);

    std::span<const glm::vec3> positions_;
    std::span<const std::array<uint32_t, 3>> triangles_;
    unsigned threads_;
    std::vector<SplitMember> order_;
    std::vector<Patch> patches_;  ///< per node
    BallNodes result_;
};

/// Level by level, until there are subtrees enough for all threads.
void Builder::build(const Subtree& whole) {
    constexpr uint32_t kLarge = 4096;
    std::vector<Subtree> level{whole}, large, small;
    while (!level.empty()) {
        std::vector<std::array<Subtree, kWidth>> below(level.size());
        parallelRuns(level.size(), 1, threads_, [&](size_t i, size_t) {
            Scratch scratch;
            below[i] = divide(level[i], level.size() == 1 ? threads_ : 1, scratch);
        });
        large.insert(large.end(), level.begin(), level.end());
        level.clear();
        for (const std::array<Subtree, kWidth>& children : below)
            for (const Subtree& child : children)
                (child.count() > kLarge ? level : small).push_back(child);
    }
    parallelRuns(small.size(), 1, threads_, [&](size_t i, size_t) {
        Scratch scratch;
        if (small[i].count() > kWidth) buildBelow(small[i], scratch);
    });
    std::for_each(large.rbegin(), large.rend(), [this](const Subtree& at) { describe(at); });
}

/// Into the node's children, each a node, a leaf or nothing.
std::array<Subtree, kWidth> Builder::divide(const Subtree& at, unsigned threads, Scratch& scratch) {
    const std::array<uint32_t, kWidth> parts = partsOf(at.count());
    const uint32_t middle = at.first + parts[0] + parts[1];
    medianSplit(part(at.first, at.last), middle - at.first, scratch);
    if (threads > 1) {
        Scratch other;
        parallelTasks(
            threads, [&] { medianSplit(part(at.first, middle), parts[0], scratch); },
            [&] { medianSplit(part(middle, at.last), parts[2], other); });
    } else {
        medianSplit(part(at.first, middle), parts[0], scratch);
        medianSplit(part(middle, at.last), parts[2], scratch);
    }
    std::array<Subtree, kWidth> children;
    uint32_t first = at.first, root = at.root + 1;
    for (size_t lane = 0; lane < kWidth; ++lane) {
        children[lane] = {first, first + parts[lane], root};
        uint32_t& child = result_.nodes[at.root].child[lane];
        child = parts[lane] > 0 ? BallNodes::kLeaf | first / kWidth : BallNodes::kNone;
        if (parts[lane] > kWidth) child = root;
        first += parts[lane];
        root += nodesOf(parts[lane]);
    }
    return children;
}

void Builder::buildBelow(const Subtree& at, Scratch& scratch) {
    for (const Subtree& child : divide(at, 1, scratch))
        if (child.count() > kWidth) buildBelow(child, scratch);
    describe(at);
}

/// Its children's boxes and slabs, which are known; and so its own box.
void Builder::describe(const Subtree& at) {
    BallNodes::Node& node = result_.nodes[at.root];
    const std::array<uint32_t, kWidth> parts = partsOf(at.count());
    Patch all;
    uint32_t first = at.first;
    for (size_t lane = 0; lane < kWidth; ++lane) {
        const Members members = part(first, first + parts[lane]);
        first += parts[lane];
        const Patch patch = parts[lane] > kWidth ? patches_[node.child[lane]] : patchOf(members);
        const Box& box = patch.box;
        all.add(patch);
        const Slab slab = slabOf(members, patch.normal);
        const bool isThere = !members.empty();
        setLane(node.centre, lane, isThere ? 0.5F * (box.low + box.high) : glm::vec3(kNowhere));
        // A little more, for what rounding took.
        const glm::vec3 extent =
            0.5F * (box.high - box.low) + 1e-6F * (glm::abs(box.low) + glm::abs(box.high));
        setLane(node.extent, lane, isThere ? extent : glm::vec3(0.0F));
        setLane(node.normal, lane, slab.normal);
        node.low.at[lane] = slab.low;
        node.high.at[lane] = slab.high;
    }
    patches_[at.root] = all;
}

Patch Builder::patchOf(Members members) const {
    Patch patch;
    for (const SplitMember& m : members) {
        const auto [a, b, c] = corners(m.triangle);
        patch.add(
            {{glm::min(a, glm::min(b, c)), glm::max(a, glm::max(b, c))}, glm::cross(b - a, c - a)});
    }
    return patch;
}

/// Across the mean normal. Large patches are not flat: theirs is without bounds.
Slab Builder::slabOf(Members members, const glm::vec3& normal) const {
    constexpr size_t kLarge = 512;
    Slab slab;
    if (members.size() > kLarge) return slab;
    const float length = glm::length(normal);
    if (length > 0) slab.normal = normal / length;
    std::swap(slab.low, slab.high);
    for (const SplitMember& m : members) {
        for (const glm::vec3& q : corners(m.triangle)) {
            const float height = glm::dot(slab.normal, q);
            slab.low = std::min(slab.low, height);
            slab.high = std::max(slab.high, height);
        }
    }
    return slab;
}

/// The i-th in the order of the leaves: neighbours in space are neighbours in memory. Beyond the
/// last it is nowhere.
void Builder::takeTriangle(size_t i) {
    BallNodes::Leaf& leaf = result_.leaves[i / kWidth];
    const size_t lane = i % kWidth;
    if (i >= order_.size()) {
        setLane(leaf.middle, lane, glm::vec3(kNowhere));
        return;
    }
    const auto [a, b, c] = corners(order_[i].triangle);
    const glm::vec3 ab = b - a, ac = c - a, cross = glm::cross(ab, ac);
    const float cross2 = glm::dot(cross, cross);
    const float ab2 = glm::dot(ab, ab), ac2 = glm::dot(ac, ac);
    const bool sliver = !(cross2 > kSliver * ab2 * ac2);
    const glm::vec3 middle = order_[i].middle;
    const glm::vec3 ma = a - middle, mb = b - middle, mc = c - middle;
    const float radius2 = std::max({glm::dot(ma, ma), glm::dot(mb, mb), glm::dot(mc, mc)});
    const glm::vec3 normal = sliver ? glm::vec3(0.0F) : cross / std::sqrt(cross2);
    setLane(leaf.middle, lane, middle);
    setLane(leaf.normal, lane, normal);
    leaf.radius.at[lane] = std::sqrt(radius2) * (1 + 1e-5F);
    leaf.offset.at[lane] = glm::dot(normal, a);
    result_.numbers[i] = order_[i].triangle;
    result_.triangles[i] = {row(a, glm::dot(ab, ac)), row(ab, ab2), row(ac, ac2)};
}

void Builder::takeFan(uint32_t i, std::span<const uint32_t> opposite,
                      std::span<const uint32_t> place) {
    BallNodes::Fan& fan = result_.fans[i];
    fan.members.fill(i);
    for (size_t k = 0; k < 3; ++k) {
        const uint32_t o = opposite[3 * size_t{order_[i].triangle} + k];
        if (o != BallNodes::kNone) fan.members[k + 1] = place[o / 3];
    }
    for (size_t lane = 0; lane < kWidth; ++lane) {
        const BallNodes::Leaf& leaf = result_.leaves[fan.members[lane] / kWidth];
        const size_t from = fan.members[lane] % kWidth;
        for (size_t axis = 0; axis < 3; ++axis)
            fan.normal[axis].at[lane] = leaf.normal[axis].at[from];
        fan.offset.at[lane] = leaf.offset.at[from];
    }
}

}  // namespace

BallNodes buildBallNodes(std::span<const glm::vec3> positions,
                         std::span<const std::array<uint32_t, 3>> triangles,
                         std::span<const uint32_t> opposite, unsigned threads) {
    return Builder(positions, triangles, threads).run(opposite);
}

}  // namespace sherd
