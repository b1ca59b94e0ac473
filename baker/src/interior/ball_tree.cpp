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
#include <numeric>
#include <thread>
#include <utility>

namespace sherd {
namespace {

constexpr float kLoose = 0.98F;     // of the radius: what is nearer to the centre shrinks the ball,
constexpr float kTight = 0.999F;    // and at last, near what it touches
constexpr float kSmallest = 1e-5F;  // balls below this are none
constexpr float kFlat = 1e-10F;     // sine squared of the angle below which a triangle is its edges
constexpr uint32_t kMaxDepth = 64;

glm::vec3 closestOnEdges(const glm::vec3& p, const std::array<glm::vec3, 3>& corner) {
    glm::vec3 best = corner[0];
    float bestDistance = std::numeric_limits<float>::infinity();
    for (size_t k = 0; k < 3; ++k) {
        const glm::vec3 a = corner[k], ab = corner[(k + 1) % 3] - a;
        const float length2 = glm::dot(ab, ab);
        const float t = length2 > 0 ? std::clamp(glm::dot(p - a, ab) / length2, 0.0F, 1.0F) : 0.0F;
        const glm::vec3 q = a + ab * t;
        const float distance = glm::dot(q - p, q - p);
        if (!(distance < bestDistance)) continue;
        bestDistance = distance;
        best = q;
    }
    return best;
}

/// As closestOnTriangle of geometry/, in float.
glm::vec3 closestPoint(const glm::vec3& p, const glm::vec3& a, const glm::vec3& b,
                       const glm::vec3& c) {
    const glm::vec3 ab = b - a, ac = c - a, ap = p - a;
    const float d00 = glm::dot(ab, ab), d01 = glm::dot(ab, ac), d11 = glm::dot(ac, ac);
    const float d20 = glm::dot(ap, ab), d21 = glm::dot(ap, ac);
    const float area = d00 * d11 - d01 * d01;
    const float v = d11 * d20 - d01 * d21, w = d00 * d21 - d01 * d20;
    // Slivers are their edges.
    if (v > 0 && w > 0 && v + w < area && area > kFlat * d00 * d11)
        return a + ab * (v / area) + ac * (w / area);
    return closestOnEdges(p, {a, b, c});
}

}  // namespace

struct BallTree::Query {
    glm::vec3 p, n, absNormal;
    glm::vec3 centre;
    float inside = kLoose;
    float radius, reach, reach2;  ///< reach: the radius less what may be entered
    uint32_t contact = kNone;

    Query(const Tangent& tangent, const Ball& ball)
        : p(tangent.point),
          n(tangent.normal),
          absNormal(glm::abs(tangent.normal)),
          contact(ball.contact) {
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
    : sinHalf_(static_cast<float>(std::sin(separationAngle / 2))) {
    triangles_.reserve(triangles.size());
    for (const auto& t : triangles) {
        const glm::vec3 a = positions[t[0]], b = positions[t[1]], c = positions[t[2]];
        const glm::vec3 normal = glm::cross(b - a, c - a);
        const float length2 = glm::dot(normal, normal);
        const bool sliver = !(length2 > kFlat * glm::dot(b - a, b - a) * glm::dot(c - a, c - a));
        const glm::vec3 middle = (a + b + c) / 3.0F;
        const float extent =
            std::sqrt(std::max({glm::dot(a - middle, a - middle), glm::dot(b - middle, b - middle),
                                glm::dot(c - middle, c - middle)}));
        triangles_.push_back({a, b, c, sliver ? glm::vec3(0.0F) : normal / std::sqrt(length2),
                              middle, extent * (1 + 1e-5F)});
    }
    std::vector<uint32_t> order(triangles_.size());
    std::iota(order.begin(), order.end(), 0U);
    if (!triangles_.empty()) {
        const auto count = static_cast<uint32_t>(triangles_.size());
        nodes_.resize(nodesOf(count));
        build(order, {0, count, 0}, threads);
    }
    renumber(order, opposite);
}

/// Triangles come to lie in the order of the leaves: neighbours in space are neighbours in memory.
void BallTree::renumber(std::span<const uint32_t> order, std::span<const uint32_t> opposite) {
    std::vector<uint32_t> place(order.size());
    std::vector<Triangle> ordered;
    ordered.reserve(order.size());
    for (uint32_t i = 0; i < order.size(); ++i) {
        place[order[i]] = i;
        ordered.push_back(triangles_[order[i]]);
    }
    triangles_ = std::move(ordered);
    beside_.resize(order.size());
    for (uint32_t i = 0; i < order.size(); ++i) {
        for (uint32_t k = 0; k < 3; ++k) {
            const uint32_t o = opposite[3 * order[i] + k];
            beside_[i][k] = o == kNone ? kNone : place[o / 3];
        }
    }
}

/// Of a subtree over so many triangles: its shape is known beforehand, so parts can be built at
/// once.
uint32_t BallTree::nodesOf(uint32_t triangles) {
    if (triangles <= kLeafSize) return 1;
    return 1 + nodesOf(triangles / 2) + nodesOf(triangles - triangles / 2);
}

void BallTree::build(std::span<uint32_t> order, const Subtree& at, unsigned threads) {
    Node& node = nodes_[at.root];
    const uint32_t count = at.last - at.first;
    if (count <= kSlabSize) setSlab(node, order.subspan(at.first, count));
    if (count <= kLeafSize) {
        setBox(node, order.subspan(at.first, count));
        node.first = at.first;
        node.count = count;
        return;
    }
    glm::vec3 low(std::numeric_limits<float>::max()), high(-low);
    for (uint32_t i = at.first; i < at.last; ++i) {
        low = glm::min(low, triangles_[order[i]].middle);
        high = glm::max(high, triangles_[order[i]].middle);
    }
    const glm::vec3 size = high - low;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
    const uint32_t middle = at.first + count / 2;
    const auto key = [&](uint32_t t) { return std::pair(triangles_[t].middle[axis], t); };
    std::nth_element(order.begin() + at.first, order.begin() + middle, order.begin() + at.last,
                     [&](uint32_t x, uint32_t y) { return key(x) < key(y); });
    const Subtree left{at.first, middle, at.root + 1};
    const Subtree right{middle, at.last, at.root + 1 + nodesOf(count / 2)};
    node.first = right.root;
    std::thread other;
    if (threads > 1) other = std::thread([&] { build(order, right, threads / 2); });
    build(order, left, (threads + 1) / 2);
    if (threads <= 1) build(order, right, 1);
    if (other.joinable()) other.join();
    const Node &l = nodes_[left.root], &r = nodes_[right.root];
    const glm::vec3 least = glm::min(l.centre - l.extent, r.centre - r.extent);
    const glm::vec3 most = glm::max(l.centre + l.extent, r.centre + r.extent);
    node.centre = 0.5F * (least + most);
    node.extent = 0.5F * (most - least) + 1e-7F;
}

void BallTree::setBox(Node& node, std::span<const uint32_t> members) const {
    glm::vec3 low = triangles_[members[0]].a, high = low;
    for (const uint32_t i : members) {
        const Triangle& t = triangles_[i];
        low = glm::min(low, glm::min(t.a, glm::min(t.b, t.c)));
        high = glm::max(high, glm::max(t.a, glm::max(t.b, t.c)));
    }
    node.centre = 0.5F * (low + high);
    // A little more, for what rounding took.
    node.extent = 0.5F * (high - low) + 1e-6F * (glm::abs(low) + glm::abs(high));
}

void BallTree::setSlab(Node& node, std::span<const uint32_t> members) const {
    glm::vec3 normal(0.0F);
    for (const uint32_t i : members) {
        const Triangle& t = triangles_[i];
        normal += glm::cross(t.b - t.a, t.c - t.a);
    }
    const float length = glm::length(normal);
    node.normal = length > 0 ? normal / length : glm::vec3(1, 0, 0);
    node.low = std::numeric_limits<float>::infinity();
    node.high = -node.low;
    for (const uint32_t i : members) {
        const Triangle& t = triangles_[i];
        for (const glm::vec3& q : {t.a, t.b, t.c}) {
            const float height = glm::dot(node.normal, q);
            node.low = std::min(node.low, height);
            node.high = std::max(node.high, height);
        }
    }
}

/// Whether points of the node may lie in the ball and in the cone of contacts.
bool BallTree::meets(const Query& query, const Node& node) const {
    const glm::vec3 d = glm::max(glm::abs(query.centre - node.centre) - node.extent, 0.0F);
    if (glm::dot(d, d) >= query.reach2) return false;
    const float height = glm::dot(node.normal, query.centre);
    if (height - node.high >= query.reach || node.low - height >= query.reach) return false;
    const glm::vec3 fromCentre = query.p - node.centre;
    const float depth = glm::dot(fromCentre, query.n) + glm::dot(node.extent, query.absNormal);
    if (depth <= 0) return false;
    const glm::vec3 e = glm::max(glm::abs(fromCentre) - node.extent, 0.0F);
    return depth * depth > sinHalf_ * sinHalf_ * glm::dot(e, e);
}

/// Whether the triangle shrank the ball.
bool BallTree::shrinkBy(Query& query, uint32_t triangle) const {
    constexpr int kMaxSteps = 40;
    const auto& [a, b, c, normal, middle, extent] = triangles_[triangle];
    const glm::vec3 toMiddle = query.p - middle;
    const float depth = glm::dot(toMiddle, query.n) + extent;
    if (depth <= 0) return false;
    const glm::vec3 fromMiddle = query.centre - middle;
    const float farthest = query.reach + extent;
    if (glm::dot(fromMiddle, fromMiddle) >= farthest * farthest) return false;
    bool shrunk = false;
    for (int step = 0; step < kMaxSteps && !query.isNone(); ++step) {
        if (std::abs(glm::dot(normal, query.centre - a)) >= query.reach) break;
        const glm::vec3 q = closestPoint(query.centre, a, b, c);
        const glm::vec3 fromCentre = q - query.centre;
        if (glm::dot(fromCentre, fromCentre) >= query.reach2) break;
        const glm::vec3 d = query.p - q;
        const float height = glm::dot(d, query.n), length2 = glm::dot(d, d);
        if (height <= 0 || height * height < sinHalf_ * sinHalf_ * length2) break;
        const float radius = length2 / (2 * height);
        if (!(radius < query.radius)) break;
        query.shrinkTo(radius);
        query.contact = triangle;
        shrunk = true;
    }
    return shrunk;
}

BallTree::Ball BallTree::largest(const Tangent& tangent, float maxRadius, uint32_t near) const {
    // What enters a ball by a small share of its radius is passed over. Beside a large ball that
    // could be a thin wall as a whole, so a small one looks first.
    constexpr float kSmall = 1.0F / 32;
    Query small(tangent, {kSmall * maxRadius, kNone});
    search(small);
    if (small.contact != kNone) return settled(small);
    Query query(tangent, {maxRadius, kNone});
    if (near != kNone) follow(query, near);
    search(query);
    return settled(query);
}

/// Shrinks the ball by everything there is.
void BallTree::search(Query& query) const {
    std::array<uint32_t, kMaxDepth> stack;
    uint32_t depth = 0;
    if (!nodes_.empty()) stack[depth++] = 0;
    while (depth > 0 && !query.isNone()) {
        const uint32_t index = stack[--depth];
        const Node& node = nodes_[index];
        if (!meets(query, node)) continue;
        if (node.count > 0) {
            for (uint32_t i = node.first; i < node.first + node.count; ++i) shrinkBy(query, i);
            continue;
        }
        uint32_t left = index + 1, right = node.first;
        const auto distance2 = [&](uint32_t child) {
            const glm::vec3 d = nodes_[child].centre - query.centre;
            return glm::dot(d, d);
        };
        if (distance2(right) < distance2(left)) std::swap(left, right);
        stack[depth++] = right;
        stack[depth++] = left;
    }
}

/// From a triangle on to whichever beside it shrinks the ball further.
void BallTree::follow(Query& query, uint32_t triangle) const {
    constexpr int kMaxSteps = 64;
    shrinkBy(query, triangle);
    for (int step = 0; step < kMaxSteps && !query.isNone(); ++step) {
        uint32_t next = kNone;
        for (const uint32_t beside : beside_[triangle])
            if (beside != kNone && shrinkBy(query, beside)) next = beside;
        if (next == kNone) return;
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

BallTree::Ball BallTree::beside(const Tangent& tangent, Ball ball,
                                std::span<const uint32_t> contacts) const {
    Query query(tangent, ball);
    for (const uint32_t contact : contacts) {
        if (query.isNone()) break;
        if (contact != kNone && contact != query.contact) follow(query, contact);
    }
    return settled(query);
}

}  // namespace sherd
