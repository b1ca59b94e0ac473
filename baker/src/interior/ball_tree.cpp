// SPDX-License-Identifier: MIT
// The shrinking ball of J. Ma, S. W. Bae, S. Choi, "3D Medial Axis Point Approximation Using
// Nearest Neighbors and the Normal Field" (2012), against triangles instead of samples. Tangent
// balls at one point are nested, so one walk through a tree does: whatever shrinks the ball also
// shrinks what is left to look at. Near the medial axis of a sphere or a tube everything is equally
// far and boxes tell nothing apart; each node therefore also knows the slab of its points, which
// hugs a patch of surface as a box cannot.
#include "interior/ball_tree.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "geometry/four.h"

namespace sherd {
namespace {

// Of the radius: what is nearer to the centre shrinks the ball, and at last, near what it touches.
// At 0.98 a search looks at a quarter more, and pieces are no better for it.
constexpr float kLoose = 0.96F;
constexpr float kTight = 0.999F;
constexpr float kSmallest = 1e-5F;   // balls below this are none
constexpr float kNoContact = 1e30F;  // instead of a distance
constexpr size_t kMaxDepth = 96;     // of the walk: three are left behind at each of 16 levels

struct FourTriangles {
    FourPoints a, ab, ac;
    Four d01, d00, d11;  ///< ab.ac, ab.ab, ac.ac
};

/// How far along a side its closest point is, 0..1, given the product of the side with where we are
/// from its start.
Four onSide(const Four& along, const Four& length2) {
    const Four nothing(std::numeric_limits<float>::min());  // instead of 0 / 0
    return xsimd::max(xsimd::min(along / xsimd::max(length2, nothing), Four(1.0F)), Four(0.0F));
}

/// As closestOnTriangle of geometry/, in float: from p to the closest points.
FourPoints towardsClosest(const FourTriangles& triangles, const FourPoints& p) {
    const auto& [a, ab, ac, d01, d00, d11] = triangles;
    const FourPoints pa = a - p;
    const Four zero(0.0F), d20 = zero - dot(pa, ab), d21 = zero - dot(pa, ac);
    const Four area = d00 * d11 - d01 * d01;
    const Four v = d11 * d20 - d01 * d21, w = d00 * d21 - d01 * d20;
    const auto inside =
        (v > zero) & (w > zero) & (v + w < area) & (area > Four(kSliver) * d00 * d11);
    const FourPoints across = pa + ab * (v / area) + ac * (w / area);
    if (xsimd::all(inside)) return across;
    FourPoints best = pa + ab * onSide(d20, d00);
    Four distance = dot(best, best);
    const auto orTowards = [&](const FourPoints& other) {
        const Four otherDistance = dot(other, other);
        best = select(otherDistance < distance, other, best);
        distance = xsimd::min(otherDistance, distance);
    };
    orTowards(pa + ac * onSide(d21, d11));
    const FourPoints pb = pa + ab, bc = ac - ab;
    orTowards(pb + bc * onSide(zero - dot(pb, bc), dot(bc, bc)));
    return select(inside, across, best);
}

}  // namespace

struct BallTree::Query {
    glm::vec3 p, n;
    glm::vec3 centre;
    float inside = kLoose;
    float radius, reach, reach2;  ///< reach: the radius less what may be entered
    uint32_t contact = kNone;

    Query(const Tangent& tangent, const Ball& ball)
        : p(tangent.point), n(tangent.normal), contact(ball.contact) {
        shrinkTo(ball.radius);
    }
    void shrinkTo(float r) {
        radius = r;
        reach = inside * r;
        reach2 = reach * reach;
        centre = p - r * n;
    }
    bool isNone() const { return radius < kSmallest; }
    void tighten() {
        inside = kTight;
        shrinkTo(radius);
    }
    Ball ball() const { return {isNone() ? 0 : radius, contact}; }
};

BallTree::BallTree(std::span<const glm::vec3> positions,
                   std::span<const std::array<uint32_t, 3>> triangles,
                   std::span<const uint32_t> opposite, double separationAngle, unsigned threads)
    : nodes_(buildBallNodes(positions, triangles, opposite, threads)),
      sinHalf_(static_cast<float>(std::sin(separationAngle / 2))) {}

/// Of the children in which points may lie in the ball and in the cone of contacts, the squared
/// distance of their boxes' centres from the ball's; kNoContact for the others.
BallTree::Children BallTree::childrenMet(const Query& query, const BallNodes::Node& node) const {
    const Four reach(query.reach);
    const FourPoints centre = loaded(node.centre), extent = loaded(node.extent);
    const FourPoints fromBall = fourTimes(query.centre) - centre;
    const FourPoints fromPoint = fourTimes(query.p) - centre;
    const FourPoints d = beyond(fromBall, extent), e = beyond(fromPoint, extent);
    const Four height = dot(loaded(node.normal), fourTimes(query.centre));
    const Four depth =
        dot(fromPoint, fourTimes(query.n)) + dot(extent, fourTimes(glm::abs(query.n)));
    const auto met = (dot(d, d) < Four(query.reach2)) & (height - loaded(node.high) < reach) &
                     (loaded(node.low) - height < reach) & (depth > Four(0.0F)) &
                     (depth * depth > Four(sinHalf_ * sinHalf_) * dot(e, e));
    if (!xsimd::any(met)) return {};
    return {true, stored(xsimd::select(met, dot(fromBall, fromBall), Four(kNoContact)))};
}

BallTree::Ball BallTree::largest(const Tangent& tangent, float maxRadius, uint32_t near) const {
    // What enters a ball by a small share of its radius is passed over. Beside a large ball that
    // could be a thin wall as a whole, so a small one looks first.
    constexpr float kSmall = 1.0F / 32;
    Query query(tangent, {maxRadius, kNone});
    if (near != kNone) follow(query, near);
    if (query.radius > kSmall * maxRadius) {
        Query small(tangent, {kSmall * maxRadius, kNone});
        search(small);
        if (small.contact != kNone) return settled(small);
    }
    search(query);
    return settled(query);
}

/// Shrinks the ball by everything there is.
void BallTree::search(Query& query) const {
    std::array<uint32_t, kMaxDepth> stack;
    size_t depth = 0;
    if (nodes_.root != kNone) stack[depth++] = nodes_.root;
    while (depth > 0 && !query.isNone()) {
        const uint32_t index = stack[--depth];
        if ((index & BallNodes::kLeaf) != 0) {
            shrinkByLeaf(query, index & ~BallNodes::kLeaf);
            continue;
        }
        const BallNodes::Node& node = nodes_.nodes[index];
        const Children met = childrenMet(query, node);
        if (!met.any) continue;
        // The nearest is looked at first: it lies on top.
        const size_t bottom = depth;
        std::array<float, BallNodes::kWidth> key;
        for (size_t i = 0; i < BallNodes::kWidth; ++i) {
            if (!(met.distance2.at[i] < kNoContact)) continue;
            size_t place = depth - bottom;
            for (; place > 0 && key[place - 1] < met.distance2.at[i]; --place) {
                key[place] = key[place - 1];
                stack[bottom + place] = stack[bottom + place - 1];
            }
            key[place] = met.distance2.at[i];
            stack[bottom + place] = node.child[i];
            ++depth;
        }
    }
}

/// By those of the leaf's triangles of which plane and surrounding ball are in reach.
void BallTree::shrinkByLeaf(Query& query, uint32_t index) const {
    const BallNodes::Leaf& leaf = nodes_.leaves[index];
    const FourPoints middle = loaded(leaf.middle);
    const Four radius = loaded(leaf.radius), reach(query.reach);
    const Four depth = dot(fourTimes(query.p) - middle, fourTimes(query.n)) + radius;
    const FourPoints away = fourTimes(query.centre) - middle;
    const Four farthest = reach + radius;
    const Four height = dot(loaded(leaf.normal), fourTimes(query.centre)) - loaded(leaf.offset);
    const auto near = (depth > Four(0.0F)) & (dot(away, away) < farthest * farthest) &
                      (xsimd::abs(height) < reach);
    if (!xsimd::any(near)) return;
    std::array<uint32_t, BallNodes::kWidth> members;
    const auto last = static_cast<uint32_t>(nodes_.triangles.size() - 1);
    for (uint32_t i = 0; i < BallNodes::kWidth; ++i)
        members[i] = std::min(BallNodes::kWidth * index + i, last);
    shrinkBySome(query, members);
}

/// Returns the one that shrank the ball last, or kNone.
uint32_t BallTree::shrinkBySome(Query& query,
                                const std::array<uint32_t, BallNodes::kWidth>& members) const {
    constexpr int kMaxSteps = 40;
    const auto gathered = [&](Lanes BallNodes::Triangle::*part) {
        const auto& t = nodes_.triangles;
        return transposed({&(t[members[0]].*part), &(t[members[1]].*part), &(t[members[2]].*part),
                           &(t[members[3]].*part)});
    };
    const auto [ax, ay, az, d01] = gathered(&BallNodes::Triangle::a);
    const auto [bx, by, bz, d00] = gathered(&BallNodes::Triangle::ab);
    const auto [cx, cy, cz, d11] = gathered(&BallNodes::Triangle::ac);
    const FourTriangles triangles{{ax, ay, az}, {bx, by, bz}, {cx, cy, cz}, d01, d00, d11};
    const Four sin2(sinHalf_ * sinHalf_), zero(0.0F);
    const FourPoints n = fourTimes(query.n);
    uint32_t last = kNone;
    for (int step = 0; step < kMaxSteps && !query.isNone(); ++step) {
        const FourPoints fromCentre = towardsClosest(triangles, fourTimes(query.centre));
        const FourPoints d = fourTimes(query.p - query.centre) - fromCentre;
        const Four height = dot(d, n), length2 = dot(d, d);
        const auto touches = (dot(fromCentre, fromCentre) < Four(query.reach2)) & (height > zero) &
                             (height * height >= sin2 * length2);
        if (!xsimd::any(touches)) break;
        const Lanes radii =
            stored(xsimd::select(touches, length2 / (Four(2.0F) * height), Four(kNoContact)));
        const auto least = std::min_element(radii.at.begin(), radii.at.end());
        if (!(*least < query.radius)) break;
        query.shrinkTo(*least);
        last = members[static_cast<size_t>(least - radii.at.begin())];
        query.contact = last;
    }
    return last;
}

/// To the ball through the triangle's middle: a first guess, better than the largest ball allowed.
void BallTree::shrinkToMiddle(Query& query, uint32_t triangle) const {
    const auto pointOf = [](const Lanes& row) {
        return glm::vec3(row.at[0], row.at[1], row.at[2]);
    };
    const BallNodes::Triangle& t = nodes_.triangles[triangle];
    const glm::vec3 d = query.p - pointOf(t.a) - (pointOf(t.ab) + pointOf(t.ac)) / 3.0F;
    const float height = glm::dot(d, query.n), length2 = glm::dot(d, d);
    if (!(height > 0) || height * height < sinHalf_ * sinHalf_ * length2) return;
    const float radius = length2 / (2 * height);
    if (!(radius < query.radius)) return;
    query.shrinkTo(radius);
    query.contact = triangle;
}

/// From a triangle on to whichever beside it shrinks the ball further. No triangle is nearer than
/// its plane: most that balls beside touch are so known to be out of reach.
void BallTree::follow(Query& query, uint32_t triangle) const {
    constexpr int kMaxSteps = 64;
    if (query.contact == kNone) shrinkToMiddle(query, triangle);
    for (int step = 0; step < kMaxSteps && !query.isNone(); ++step) {
        const BallNodes::Fan& fan = nodes_.fans[triangle];
        const Four height = dot(loaded(fan.normal), fourTimes(query.centre)) - loaded(fan.offset);
        if (!xsimd::any(xsimd::abs(height) < Four(query.reach))) return;
        const uint32_t next = shrinkBySome(query, fan.members);
        if (next == kNone || next == triangle) return;
        triangle = next;
    }
}

BallTree::Ball BallTree::settled(Query& query) const {
    if (query.contact != kNone && !query.isNone()) {
        query.tighten();
        follow(query, query.contact);
    }
    return query.ball();
}

/// What a step of `follow` looked at and passed over need not be where the next one begins.
BallTree::Ball BallTree::beside(const Tangent& tangent, Ball ball,
                                std::span<const uint32_t> contacts) const {
    constexpr size_t kMost = 4;  // remembered
    std::array<uint32_t, kMost> followed;
    size_t count = 0;
    if (ball.contact != kNone) followed[count++] = ball.contact;
    const auto isKnown = [&](uint32_t contact) {
        for (size_t i = 0; i < count; ++i) {
            const auto& members = nodes_.fans[followed[i]].members;
            if (std::find(members.begin(), members.end(), contact) != members.end()) return true;
        }
        return false;
    };
    Query query(tangent, ball);
    query.tighten();
    for (const uint32_t contact : contacts) {
        if (query.isNone()) break;
        if (contact == kNone || isKnown(contact)) continue;
        follow(query, contact);
        if (count < kMost) followed[count++] = contact;
    }
    return query.ball();
}

}  // namespace sherd
