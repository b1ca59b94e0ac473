// SPDX-License-Identifier: MIT
#include "interior/ball_nodes.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <thread>
#include <utility>

#include "geometry/parallel_for.h"

namespace sherd {
namespace {

constexpr float kNowhere = 1e18F;  // where the boxes and triangles are that are none
constexpr float kUnbounded = 1e30F;
constexpr uint32_t kWidth = BallNodes::kWidth;
constexpr size_t kGrain = 1024;  // leaves

struct Box {
    glm::vec3 low{kUnbounded}, high{-kUnbounded};
};
struct Slab {
    glm::vec3 normal{1, 0, 0};
    float low = -kUnbounded, high = kUnbounded;
};
struct Member {
    glm::vec3 middle;
    uint32_t triangle;
};
/// Of the order of the triangles, and where its nodes go.
struct Subtree {
    uint32_t first, last;
    uint32_t root;
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

class Builder {
  public:
    Builder(std::span<const glm::vec3> positions,
            std::span<const std::array<uint32_t, 3>> triangles)
        : positions_(positions), triangles_(triangles), order_(triangles.size()) {
        for (uint32_t t = 0; t < order_.size(); ++t) {
            const auto [a, b, c] = corners(t);
            order_[t] = {(a + b + c) / 3.0F, t};
        }
    }

    BallNodes run(std::span<const uint32_t> opposite, unsigned threads) {
        const auto count = static_cast<uint32_t>(triangles_.size());
        if (count == 0) return {};
        result_.nodes.resize(nodesOf(count));
        result_.root = count <= kWidth ? BallNodes::kLeaf : 0;
        if (count > kWidth) build({0, count, 0}, threads);
        result_.leaves.resize(leavesOf(count));
        result_.triangles.resize(count);
        result_.beside.resize(count);
        result_.numbers.resize(count);
        std::vector<uint32_t> place(count);
        for (uint32_t i = 0; i < count; ++i) place[order_[i].triangle] = i;
        parallelRuns(result_.leaves.size(), kGrain, threads, [&](size_t first, size_t last) {
            for (size_t i = kWidth * first; i < kWidth * last; ++i) {
                takeTriangle(i);
                if (i < count) takeBeside(i, opposite, place);
            }
        });
        return std::move(result_);
    }

  private:
    std::array<glm::vec3, 3> corners(uint32_t triangle) const {
        const auto& [a, b, c] = triangles_[triangle];
        return {positions_[a], positions_[b], positions_[c]};
    }
    std::span<Member> part(uint32_t first, uint32_t count) {
        return std::span(order_).subspan(first, count);
    }

    Box build(const Subtree& at, unsigned threads);
    Box buildChild(const Subtree& at, uint32_t& child, unsigned threads);
    void split(std::span<Member> members, uint32_t left) const;
    Box boxOf(std::span<const Member> members) const;
    Slab slabOf(std::span<const Member> members) const;
    void describe(BallNodes::Node& node, size_t lane, const Box& box,
                  std::span<const Member> members) const;
    void takeTriangle(size_t i);
    void takeBeside(size_t i, std::span<const uint32_t> opposite, std::span<const uint32_t> place);

    std::span<const glm::vec3> positions_;
    std::span<const std::array<uint32_t, 3>> triangles_;
    std::vector<Member> order_;
    BallNodes result_;
};

/// Returns the box around what is below the node.
Box Builder::build(const Subtree& at, unsigned threads) {
    const std::array<uint32_t, kWidth> parts = partsOf(at.last - at.first);
    const uint32_t left = parts[0] + parts[1];
    split(part(at.first, at.last - at.first), left);
    std::array<Box, kWidth> boxes;
    std::array<uint32_t, kWidth>& children = result_.nodes[at.root].child;
    const auto buildHalf = [&](size_t lane, Subtree child, unsigned share) {
        split(part(child.first, parts[lane] + parts[lane + 1]), parts[lane]);
        for (const size_t end = lane + 2; lane < end; ++lane) {
            child.last = child.first + parts[lane];
            boxes[lane] = buildChild(child, children[lane], share);
            child.first = child.last;
            child.root += nodesOf(parts[lane]);
        }
    };
    const Subtree first{at.first, 0, at.root + 1};
    const Subtree second{at.first + left, 0, first.root + nodesOf(parts[0]) + nodesOf(parts[1])};
    std::thread other;
    if (threads > 1) other = std::thread([&] { buildHalf(2, second, threads / 2); });
    buildHalf(0, first, (threads + 1) / 2);
    if (threads <= 1) buildHalf(2, second, 1);
    if (other.joinable()) other.join();
    Box all;
    uint32_t start = at.first;
    for (size_t lane = 0; lane < kWidth; ++lane) {
        describe(result_.nodes[at.root], lane, boxes[lane], part(start, parts[lane]));
        start += parts[lane];
        all = {glm::min(all.low, boxes[lane].low), glm::max(all.high, boxes[lane].high)};
    }
    return all;
}

/// A leaf, a node of its own, or nothing.
Box Builder::buildChild(const Subtree& at, uint32_t& child, unsigned threads) {
    const uint32_t count = at.last - at.first;
    if (count > kWidth) {
        child = at.root;
        return build(at, threads);
    }
    child = count > 0 ? BallNodes::kLeaf | at.first / kWidth : BallNodes::kNone;
    return boxOf(part(at.first, count));
}

/// Across the longest side of the box around the middles.
void Builder::split(std::span<Member> members, uint32_t left) const {
    if (left == members.size()) return;
    Box box;
    for (const Member& m : members)
        box = {glm::min(box.low, m.middle), glm::max(box.high, m.middle)};
    const glm::vec3 size = box.high - box.low;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
    std::nth_element(members.begin(), members.begin() + left, members.end(),
                     [axis](const Member& x, const Member& y) {
                         return std::pair(x.middle[axis], x.triangle) <
                                std::pair(y.middle[axis], y.triangle);
                     });
}

Box Builder::boxOf(std::span<const Member> members) const {
    Box box;
    for (const Member& m : members) {
        for (const glm::vec3& q : corners(m.triangle))
            box = {glm::min(box.low, q), glm::max(box.high, q)};
    }
    return box;
}

/// Across the mean normal. Large patches are not flat: theirs is without bounds.
Slab Builder::slabOf(std::span<const Member> members) const {
    constexpr size_t kLarge = 512;
    Slab slab;
    if (members.size() > kLarge) return slab;
    glm::vec3 normal(0.0F);
    for (const Member& m : members) {
        const auto [a, b, c] = corners(m.triangle);
        normal += glm::cross(b - a, c - a);
    }
    const float length = glm::length(normal);
    if (length > 0) slab.normal = normal / length;
    std::swap(slab.low, slab.high);
    for (const Member& m : members) {
        for (const glm::vec3& q : corners(m.triangle)) {
            const float height = glm::dot(slab.normal, q);
            slab.low = std::min(slab.low, height);
            slab.high = std::max(slab.high, height);
        }
    }
    return slab;
}

void Builder::describe(BallNodes::Node& node, size_t lane, const Box& box,
                       std::span<const Member> members) const {
    const Slab slab = slabOf(members);
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

void Builder::takeBeside(size_t i, std::span<const uint32_t> opposite,
                         std::span<const uint32_t> place) {
    for (size_t k = 0; k < 3; ++k) {
        const uint32_t o = opposite[3 * size_t{order_[i].triangle} + k];
        result_.beside[i][k] = o == BallNodes::kNone ? BallNodes::kNone : place[o / 3];
    }
}

}  // namespace

BallNodes buildBallNodes(std::span<const glm::vec3> positions,
                         std::span<const std::array<uint32_t, 3>> triangles,
                         std::span<const uint32_t> opposite, unsigned threads) {
    return Builder(positions, triangles).run(opposite, threads);
}

}  // namespace sherd
