// SPDX-License-Identifier: MIT
#include "core/bond_network.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace sherd {
namespace {

constexpr uint32_t kGround = ElasticNetwork::kGround;

glm::dvec3 unitNormal(const BondGraph::Bond& bond, const glm::dvec3& fromAToB) {
    const glm::dvec3 normal(bond.normal);
    const double length = glm::length(normal);
    if (length > 1e-6) return normal / length;
    const double apart = glm::length(fromAToB);
    return apart > 0 ? fromAToB / apart : glm::dvec3(0, 1, 0);
}

/// Of a bar of square section as long as two centres are apart along the normal, with Young's
/// modulus 1: which one does not matter for the forces. In bending, where area counts twice, the
/// smallest bonds count for a thousandth of the mean area: the stress they get by it stays below
/// that of the others.
Stiffness stiffnessOf(double area, double meanArea, double distance, const glm::dvec3& normal) {
    constexpr double kShear = 0.4;  // shear modulus over Young's at Poisson's ratio 1/4
    constexpr double kThick = 0.1;  // of the bond's width; centres may lie in it
    const double length = std::max(distance, kThick * std::sqrt(area));
    const double bending = area * std::max(area, 1e-3 * meanArea) / 12;
    const glm::dmat3 along = glm::outerProduct(normal, normal);
    const glm::dmat3 across = glm::dmat3(1.0) - along;
    Stiffness s;
    s.linear = area / length * (along + kShear * across);
    s.angular = bending / length * (2 * kShear * along + across);
    return s;
}

}  // namespace

void BondNetwork::reset(const Structure& structure, std::span<const uint32_t> fragments) {
    findLinks(structure, fragments);
    keepGrounded();
    addEdges(structure);
    // Every node its own aggregate: that makes one edge of many between the same two.
    parent_.resize(fragments_.size());
    std::iota(parent_.begin(), parent_.end(), 0U);
    aggregation_.merge(single_, parent_, uint32_t(fragments_.size()), network_);
}

void BondNetwork::findLinks(const Structure& structure, std::span<const uint32_t> fragments) {
    const BondGraph& graph = structure.graph();
    nodeOf_.assign(structure.asset().fragmentCount(), kNone);
    fragments_.clear();
    for (const uint32_t f : fragments) {
        if (f >= nodeOf_.size() || nodeOf_[f] != kNone || !structure.stands(f)) continue;
        nodeOf_[f] = uint32_t(fragments_.size());
        fragments_.push_back(f);
    }
    links_.clear();
    pins_.clear();
    for (uint32_t node = 0; node < fragments_.size(); ++node) {
        const Range leaves = graph.leavesOf(fragments_[node]);
        for (uint32_t leaf = leaves.first; leaf < leaves.first + leaves.count; ++leaf) {
            if (structure.isPinned(leaf)) pins_.push_back({node, leaf});
            for (const BondGraph::Edge& edge : graph.edgesOf(leaf)) {
                if (graph.bond(edge.bond).a != leaf || structure.isBroken(edge.bond)) continue;
                const bool isAnchor = edge.other == BondGraph::kWorld;
                const uint32_t other =
                    isAnchor ? kGround : nodeOf_[structure.fragmentAt(edge.other)];
                if (other == node || (!isAnchor && other == kNone)) continue;
                Link& link = links_.emplace_back();
                link.bond = edge.bond;
                link.a = node;
                link.b = other;
            }
        }
    }
}

uint32_t BondNetwork::rootOf(uint32_t node) {
    while (parent_[node] != node) node = parent_[node] = parent_[parent_[node]];
    return node;
}

/// Drops what floats: there the forces balance for no motion or for too many.
void BondNetwork::keepGrounded() {
    const auto ground = uint32_t(fragments_.size());
    parent_.resize(size_t(ground) + 1);
    std::iota(parent_.begin(), parent_.end(), 0U);
    for (const Link& link : links_)
        parent_[rootOf(link.a)] = rootOf(link.b == kGround ? ground : link.b);
    for (const Pin& pin : pins_) parent_[rootOf(pin.node)] = rootOf(ground);
    uint32_t kept = 0;
    for (uint32_t node = 0; node < ground; ++node) {
        const uint32_t fragment = fragments_[node];
        const bool isGrounded = rootOf(node) == rootOf(ground);
        nodeOf_[fragment] = isGrounded ? kept : kNone;
        if (isGrounded) ++kept;
    }
    const auto isFloating = [&](const Link& link) { return nodeOf_[fragments_[link.a]] == kNone; };
    links_.erase(std::remove_if(links_.begin(), links_.end(), isFloating), links_.end());
    for (Link& link : links_) {
        link.a = nodeOf_[fragments_[link.a]];
        if (link.b != kGround) link.b = nodeOf_[fragments_[link.b]];
    }
    for (Pin& pin : pins_) pin.node = nodeOf_[fragments_[pin.node]];
    const auto floats = [&](uint32_t fragment) { return nodeOf_[fragment] == kNone; };
    fragments_.erase(std::remove_if(fragments_.begin(), fragments_.end(), floats),
                     fragments_.end());
}

void BondNetwork::addEdges(const Structure& structure) {
    const BondGraph& graph = structure.graph();
    double meanArea = 0;
    for (Link& link : links_) {
        link.area = double(graph.bond(link.bond).area);
        meanArea += link.area;
    }
    meanArea /= double(std::max<size_t>(links_.size(), 1));
    unit_ = meanArea > 0 ? std::ldexp(1.0, std::ilogb(std::sqrt(meanArea))) : 1;
    // Slivers of any smallness come out of cutting. They would carry next to nothing, and rounding
    // is large against that.
    for (Link& link : links_) link.area = std::max(link.area, 1e-6 * meanArea);
    meanArea /= unit_ * unit_;

    const auto centerOf = [&](uint32_t fragment) {
        return glm::dvec3(structure.asset().fragment(fragment).centerOfMass) / unit_;
    };
    single_.centers.clear();
    for (const uint32_t fragment : fragments_) single_.centers.push_back(centerOf(fragment));
    single_.edges.clear();
    single_.edges.reserve(links_.size() + pins_.size());
    network_.edges.reserve(links_.size() + pins_.size());
    for (Link& link : links_) {
        const BondGraph::Bond& bond = graph.bond(link.bond);
        const double area = link.area / (unit_ * unit_);
        const glm::dvec3 place = glm::dvec3(bond.centroid) / unit_;
        ElasticNetwork::Edge& edge = single_.edges.emplace_back();
        edge.a = link.a;
        edge.b = link.b;
        edge.armA = place - single_.centers[link.a];
        glm::dvec3 fromAToB = edge.armA;
        if (link.b != kGround) {
            edge.armB = place - single_.centers[link.b];
            fromAToB -= edge.armB;
        }
        link.normal = unitNormal(bond, fromAToB);
        const double distance =
            std::abs(glm::dot(edge.armA, link.normal)) + std::abs(glm::dot(edge.armB, link.normal));
        edge.stiffness = stiffnessOf(area, meanArea, distance, link.normal);
        if (edge.a > edge.b) {
            std::swap(edge.a, edge.b);
            std::swap(edge.armA, edge.armB);
        }
    }
    addPins(structure, meanArea);
}

/// A pin holds its leaf in the middle, as stiff as a cube of the size of bonds and in turning as
/// well: so what hangs from several shares its load between them.
void BondNetwork::addPins(const Structure& structure, double meanArea) {
    const double area = meanArea > 0 ? meanArea : 1;
    for (const Pin& pin : pins_) {
        const Fragment& leaf =
            structure.asset().fragment(structure.graph().fragmentOfLeaf(pin.leaf));
        ElasticNetwork::Edge& edge = single_.edges.emplace_back();
        edge.a = pin.node;
        edge.armA = glm::dvec3(leaf.centerOfMass) / unit_ - single_.centers[pin.node];
        edge.stiffness.linear = glm::dmat3(std::sqrt(area));
        edge.stiffness.angular = glm::dmat3(area * std::sqrt(area) / 12);
    }
}

Screw BondNetwork::wrenchOf(size_t link, std::span<const Screw> motion) const {
    const ElasticNetwork::Edge& edge = single_.edges[link];
    const Screw onFirst = wrenchOnA(edge, motion);
    if (edge.a == links_[link].a) return onFirst;
    return {-onFirst.linear, -onFirst.angular};
}

}  // namespace sherd
