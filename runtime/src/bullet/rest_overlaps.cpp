// SPDX-License-Identifier: MIT
#include "bullet/rest_overlaps.h"

#include <BulletCollision/BroadphaseCollision/btDbvt.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "bullet/convert.h"
#include "bullet/fragment_shapes.h"
#include "bullet/overlaps.h"

namespace sherd {
namespace {

/// How far a fragment's colliders reach along a unit direction, metres.
float reachAlong(const Asset& asset, uint32_t fragment, const glm::vec3& direction) {
    const FractureSet& set = asset.set();
    float reach = -HUGE_VALF;
    const Range hulls = asset.fragment(fragment).hulls;
    for (uint32_t h = hulls.first; h < hulls.first + hulls.count; ++h) {
        const ConvexHull& hull = set.hulls[h];
        for (uint32_t p = hull.points.first; p < hull.points.first + hull.points.count; ++p)
            reach = std::max(reach, glm::dot(set.hullPoints[p], direction) + hull.margin);
    }
    return reach;
}

/// Most neighbours are parted by the plane of their bond, which is quickly seen.
bool arePartedByBond(const Asset& asset, uint32_t a, uint32_t b, float tolerance) {
    const BondGraph& graph = asset.graph();
    const Range leaves = graph.leavesOf(a), others = graph.leavesOf(b);
    if (leaves.count != 1 || others.count != 1) return false;
    for (const BondGraph::Edge& edge : graph.edgesOf(leaves.first)) {
        if (edge.other != others.first) continue;
        const BondGraph::Bond& bond = graph.bond(edge.bond);
        const glm::vec3 toOther = bond.a == leaves.first ? bond.normal : -bond.normal;
        if (reachAlong(asset, a, toOther) + reachAlong(asset, b, -toOther) <= tolerance)
            return true;
    }
    return false;
}

/// Pairs of fragments whose boxes overlap by more than the tolerance, but for those of which one is
/// a part of the other.
std::vector<std::pair<uint32_t, uint32_t>> nearPairs(const Asset& asset, float tolerance) {
    struct Collector final : btDbvt::ICollide {
        explicit Collector(const BondGraph& bonds) : graph(bonds) {}
        void Process(const btDbvtNode* x, const btDbvtNode* y) override {
            const auto a = uint32_t(x->dataAsInt), b = uint32_t(y->dataAsInt);
            const bool isPart = graph.contains(a, graph.leavesOf(b).first) ||
                                graph.contains(b, graph.leavesOf(a).first);
            if (!isPart) pairs.emplace_back(std::min(a, b), std::max(a, b));
        }
        const BondGraph& graph;
        std::vector<std::pair<uint32_t, uint32_t>> pairs;
    };
    btDbvt tree;
    const btVector3 inset(tolerance / 2, tolerance / 2, tolerance / 2);
    for (uint32_t f = 0; f < asset.fragmentCount(); ++f) {
        const Asset::Box& box = asset.box(f);
        const btVector3 low = toBullet(box.low) + inset, high = toBullet(box.high) - inset;
        if (low.x() > high.x() || low.y() > high.y() || low.z() > high.z()) continue;
        btDbvtNode* node = tree.insert(btDbvtVolume::FromMM(low, high), nullptr);
        node->dataAsInt = int(f);
    }
    Collector collector(asset.graph());
    tree.collideTT(tree.m_root, tree.m_root, collector);
    std::sort(collector.pairs.begin(), collector.pairs.end());
    return std::move(collector.pairs);
}

}  // namespace

RestOverlaps::RestOverlaps(const FragmentShapes& shapes, float tolerance) : tolerance_(tolerance) {
    const Asset& asset = *shapes.asset();
    const float depth = tolerance * asset.diagonal();
    std::vector<std::pair<uint32_t, uint32_t>> found;
    btCollisionObject first, second;
    for (const auto& [a, b] : nearPairs(asset, depth)) {
        if (arePartedByBond(asset, a, b, depth)) continue;
        first.setCollisionShape(shapes.shape(a));
        first.setWorldTransform(shapes.bodyFrame(a));
        second.setCollisionShape(shapes.shape(b));
        second.setWorldTransform(shapes.bodyFrame(b));
        if (!penetrates(first, second, depth)) continue;
        found.emplace_back(a, b);
        found.emplace_back(b, a);
    }
    std::sort(found.begin(), found.end());
    first_.assign(asset.fragmentCount() + 1, 0);
    others_.reserve(found.size());
    for (const auto& [a, b] : found) {
        ++first_[a + 1];
        others_.push_back(b);
    }
    for (size_t f = 1; f < first_.size(); ++f) first_[f] += first_[f - 1];
}

}  // namespace sherd
