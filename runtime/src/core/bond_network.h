// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "core/aggregation.h"
#include "core/elastic_network.h"
#include "sherd/runtime/memory.h"
#include "sherd/runtime/structure.h"

namespace sherd {

/// An island as rigid fragments and elastic bonds, those between the same two fragments as one.
/// Only what hangs together with the world, by bonds or pins, is in it. Keeps its memory.
class BondNetwork {
  public:
    static constexpr uint32_t kNone = UINT32_MAX;

    void reset(const Structure& structure, std::span<const uint32_t> fragments);

    [[nodiscard]] const ElasticNetwork& network() const { return network_; }
    /// Metres: the unit of length of the networks, a power of two near the size of a bond.
    [[nodiscard]] double unit() const { return unit_; }
    [[nodiscard]] std::span<const uint32_t> fragments() const { return fragments_; }
    [[nodiscard]] uint32_t nodeOf(uint32_t fragment) const {
        return fragment < nodeOf_.size() ? nodeOf_[fragment] : kNone;
    }

    /// One that is not broken and joins two nodes, or one and the world.
    struct Link {
        uint32_t bond;
        uint32_t a, b;    ///< the nodes of its leaves a and b; b may be ElasticNetwork::kGround
        double area = 0;  ///< that counts, m^2: a millionth of the mean at least
        glm::dvec3 normal{0.0};  ///< unit, from a to b
    };
    [[nodiscard]] std::span<const Link> links() const { return links_; }
    /// What the bond does to its leaf a about its centroid when the nodes move so: N and N x units
    /// when `motion` is K^-1 of such.
    [[nodiscard]] Screw wrenchOf(size_t link, std::span<const Screw> motion) const;

  private:
    void findLinks(const Structure& structure, std::span<const uint32_t> fragments);
    void keepGrounded();
    uint32_t rootOf(uint32_t node);
    void addEdges(const Structure& structure);
    void addPins(const Structure& structure, double meanArea);

    ElasticNetwork network_;
    ElasticNetwork single_;  ///< one edge per link, then one per pin
    double unit_ = 1;
    Vector<uint32_t> fragments_;
    Vector<uint32_t> nodeOf_;  ///< per fragment of the asset
    Vector<Link> links_;
    struct Pin {
        uint32_t node, leaf;
    };
    Vector<Pin> pins_;
    Vector<uint32_t> parent_;  ///< a forest over the nodes and, last, the ground
    Aggregation aggregation_;
};

}  // namespace sherd
