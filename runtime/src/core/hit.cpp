// SPDX-License-Identifier: MIT
// How energy spreads from a contact over the bond graph. A crack that has started runs: all leaf
// bonds between two standing fragments fail as one.
#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <tuple>
#include <utility>

#include "core/bond_price.h"
#include "sherd/runtime/structure.h"

namespace sherd {
namespace {

/// All that is left of the bonds between two fragments, or of one and the world.
struct Seam {
    uint32_t a = 0, b = 0;
    float energy = 0;  ///< that breaking it would consume, J
    float weight = 0;  ///< its share of the energy: area, by nearness squared
    uint32_t firstBond = 0, bondCount = 0;
};

/// The factor from which a seam breaks, as bits that are ordered as it is.
uint64_t needOf(const Seam& seam) {
    return std::bit_cast<uint32_t>(seam.energy > 0 ? seam.energy / seam.weight : 0.0F);
}

struct Crossing {
    uint32_t other, bond;
};

}  // namespace

struct HitSolver::Scratch {
    Vector<Seam> seams;      ///< that fail at this stress
    Vector<uint32_t> bonds;  ///< of the seams
    /// Of every seam the factor from which it breaks, and its place: a heap, the least in front.
    Vector<uint64_t> needs;
    Vector<Crossing> crossings;
    Vector<uint32_t> front;  ///< fragments reached, in that order
    /// Per fragment: the round in which it was reached, and the one in which its seams were found.
    Vector<uint32_t> reached, done;
    uint32_t round = 0;

    void nextRound(uint32_t fragments) {
        if (reached.size() < fragments) {
            reached.resize(fragments, 0);
            done.resize(fragments, 0);
        }
        if (++round == 0) {
            std::fill(reached.begin(), reached.end(), 0U);
            std::fill(done.begin(), done.end(), 0U);
            round = 1;
        }
        seams.clear();
        bonds.clear();
        needs.clear();
        front.clear();
    }
    void reach(uint32_t fragment) {
        if (reached[fragment] == round) return;
        reached[fragment] = round;
        front.push_back(fragment);
    }
};

namespace {

class Spreading {
  public:
    Spreading(Structure& structure, const Hit& hit, const DamageOptions& options,
              HitSolver::Scratch& scratch)
        : structure_(structure),
          graph_(structure.graph()),
          hit_(hit),
          options_(options),
          scratch_(scratch) {}

    void run(HitResult& result) {
        result.clear();
        uint32_t target = hit_.fragment;
        float left = hit_.energy;
        while (left > 0) {
            divided_ = isBreakable(structure_.asset(), target, options_) ? target : kNone;
            findSeams(target);
            const float before = left;
            const bool opens = breakSeams(left, result);
            result.consumed += before - left;
            if (!opens) break;
            structure_.open(target);
            result.opened.push_back(target);
            target = childAt(target);
        }
        result.struck = target;
    }

  private:
    static constexpr uint32_t kNone = UINT32_MAX;

    /// The fragment a leaf counts for now.
    uint32_t sideOf(uint32_t leaf) const {
        if (leaf == BondGraph::kWorld) return kNone;
        const uint32_t fragment = structure_.fragmentAt(leaf);
        return fragment == divided_ ? graph_.childWith(fragment, leaf) : fragment;
    }
    void findSeams(uint32_t target);
    void addSeamsOf(uint32_t side);
    bool breakSeams(float& left, HitResult& result);
    uint32_t childAt(uint32_t fragment) const;
    std::span<const uint32_t> bondsOf(const Seam& seam) const {
        return std::span(scratch_.bonds).subspan(seam.firstBond, seam.bondCount);
    }

    Structure& structure_;
    const BondGraph& graph_;
    const Hit& hit_;
    const DamageOptions& options_;
    uint32_t divided_ = kNone;  ///< standing, but seen as its children
    float radius_ = 0;          ///< of the struck fragment, half of its diagonal, metres
    HitSolver::Scratch& scratch_;
};

/// From the struck fragment on, through every seam the stress can break.
void Spreading::findSeams(uint32_t target) {
    scratch_.nextRound(structure_.asset().fragmentCount());
    // Half across, not of equal volume: thin walls guide what strikes them farther than it would go
    // in a lump.
    const auto& [low, high] = structure_.asset().box(target);
    radius_ = std::max(0.5F * glm::distance(low, high), std::numeric_limits<float>::min());
    if (divided_ == kNone) {
        scratch_.reach(target);
    } else {
        const Range children = structure_.asset().fragment(target).children;
        for (uint32_t c = 0; c < children.count; ++c) scratch_.reach(children.first + c);
    }
    // It grows as seams are found.
    size_t next = 0;
    while (next < scratch_.front.size()) addSeamsOf(scratch_.front[next++]);
}

void Spreading::addSeamsOf(uint32_t side) {
    auto& [seams, bonds, needs, crossings, front, reached, done, round] = scratch_;
    done[side] = round;
    crossings.clear();
    const Range leaves = graph_.leavesOf(side);
    for (const BondGraph::Edge& edge : graph_.edgesOf(leaves)) {
        // The world is in no run of leaves.
        if (edge.other - leaves.first < leaves.count) continue;
        const uint32_t other = sideOf(edge.other);
        if (other != kNone && done[other] == round) continue;
        if (!structure_.isBroken(edge.bond)) crossings.push_back({other, edge.bond});
    }
    // Those of one leaf lie by what is across already.
    if (leaves.count > 1) {
        std::sort(crossings.begin(), crossings.end(), [](const Crossing& x, const Crossing& y) {
            return std::tie(x.other, x.bond) < std::tie(y.other, y.bond);
        });
    }
    for (size_t i = 0; i < crossings.size();) {
        const uint32_t other = crossings[i].other;
        const auto firstBond = uint32_t(bonds.size());
        float area = 0, energy = 0, strength = HUGE_VALF, distance = HUGE_VALF;
        for (; i < crossings.size() && crossings[i].other == other; ++i) {
            const uint32_t b = crossings[i].bond;
            const BondGraph::Bond& bond = graph_.bond(b);
            area += bond.area;
            energy += priceOf(structure_.asset(), bond, options_) * structure_.health(b);
            strength = std::min(strength, strengthOf(structure_.asset(), bond, options_));
            const glm::vec3 way = bond.centroid - hit_.point;
            distance = std::min(distance, glm::dot(way, way));
            bonds.push_back(b);
        }
        // How near it is, 1..0: one radius of the struck fragment away it is 1/2.
        const float near = radius_ / (radius_ + std::sqrt(distance));
        if (!(hit_.stress * near > strength)) {
            bonds.resize(firstBond);
            continue;
        }
        seams.push_back({side, other, energy, near * near * area, firstBond,
                         uint32_t(bonds.size()) - firstBond});
        if (other != kNone) scratch_.reach(other);
    }
}

/// Gives every seam its share of the energy. Returns whether the divided fragment falls open.
bool Spreading::breakSeams(float& left, HitResult& result) {
    const auto isInside = [&](const Seam& seam) {
        const auto parentOf = [&](uint32_t f) {
            return f == kNone ? int32_t(-1) : structure_.asset().fragment(f).parent;
        };
        return divided_ != kNone && parentOf(seam.a) == int32_t(divided_) &&
               parentOf(seam.b) == int32_t(divided_);
    };
    // Of a factor f, a seam gets f x its weight, or all it can take: it breaks from f = need on.
    // With the seams in that order, those in front break, the others share the rest.
    const Vector<Seam>& seams = scratch_.seams;
    Vector<uint64_t>& needs = scratch_.needs;
    double weights = 0;
    for (uint32_t s = 0; s < seams.size(); ++s) {
        weights += double(seams[s].weight);
        needs.push_back(needOf(seams[s]) << 32 | s);
    }
    std::make_heap(needs.begin(), needs.end(), std::greater<>());
    bool opens = false;
    double rest = double(left);
    while (!needs.empty()) {
        const Seam& seam = seams[uint32_t(needs.front())];
        if (!(double(seam.energy) * weights <= rest * double(seam.weight))) break;
        std::pop_heap(needs.begin(), needs.end(), std::greater<>());
        needs.pop_back();
        rest -= double(seam.energy);
        weights -= double(seam.weight);
        for (const uint32_t b : bondsOf(seam)) {
            structure_.breakBond(b);
            result.bonds.push_back(b);
            result.area += graph_.bond(b).area;
            result.level = std::max(result.level,
                                    structure_.asset().fragment(graph_.bond(b).parting).level + 1);
        }
        opens = opens || isInside(seam);
    }
    if (!needs.empty() && weights > 0) {
        const double factor = rest / weights;
        for (const uint64_t need : needs) {
            const Seam& seam = seams[uint32_t(need)];
            if (!(seam.energy > 0)) continue;
            const float share =
                float(factor * double(seam.weight)) / seam.energy;  // of what is left
            for (const uint32_t b : bondsOf(seam))
                structure_.weaken(b, share * structure_.health(b));
        }
        rest = 0;
    }
    // Children that nothing holds together cost the least there is.
    if (divided_ != kNone && !opens && rest > double(options_.minimumEnergy)) {
        bool isBonded = false;
        for (const BondGraph::Edge& edge : graph_.edgesOf(graph_.leavesOf(divided_)))
            isBonded = isBonded || (graph_.bond(edge.bond).parting == divided_ &&
                                    edge.other != BondGraph::kWorld);
        if (!isBonded) {
            opens = true;
            rest -= double(options_.minimumEnergy);
        }
    }
    left = float(std::max(rest, 0.0));
    return opens;
}

/// The child the hit met: the one whose colliders' box is nearest to the point.
uint32_t Spreading::childAt(uint32_t fragment) const {
    const Asset& asset = structure_.asset();
    const Range children = asset.fragment(fragment).children;
    uint32_t nearest = children.first;
    auto least = std::pair(HUGE_VALF, HUGE_VALF);
    for (uint32_t c = children.first; c < children.first + children.count; ++c) {
        const std::pair distance(Asset::distance(asset.box(c), hit_.point),
                                 glm::distance(hit_.point, asset.fragment(c).centerOfMass));
        if (!(distance < least)) continue;
        least = distance;
        nearest = c;
    }
    return nearest;
}

}  // namespace

HitSolver::HitSolver() : scratch_(std::make_unique<Scratch>()) {}
HitSolver::~HitSolver() = default;
HitSolver::HitSolver(HitSolver&&) noexcept = default;
HitSolver& HitSolver::operator=(HitSolver&&) noexcept = default;

void HitSolver::apply(Structure& structure, const Hit& hit, const DamageOptions& options,
                      HitResult& result) {
    Spreading(structure, hit, options, *scratch_).run(result);
}

void shatter(Structure& structure, uint32_t fragment, bool whole, HitResult& result) {
    const BondGraph& graph = structure.graph();
    result.clear();
    const auto breakAround = [&](uint32_t part) {
        const Range leaves = graph.leavesOf(part);
        for (uint32_t leaf = leaves.first; leaf < leaves.first + leaves.count; ++leaf) {
            for (const BondGraph::Edge& edge : graph.edgesOf(leaf)) {
                const bool isInner =
                    edge.other != BondGraph::kWorld && graph.contains(part, edge.other);
                if (isInner || structure.isBroken(edge.bond)) continue;
                structure.breakBond(edge.bond);
                result.bonds.push_back(edge.bond);
                result.area += graph.bond(edge.bond).area;
            }
        }
    };
    const Fragment& broken = structure.asset().fragment(fragment);
    result.level = broken.level;
    result.struck = fragment;
    if (whole || broken.children.count == 0) {
        breakAround(fragment);
        return;
    }
    ++result.level;
    for (uint32_t c = 0; c < broken.children.count; ++c) breakAround(broken.children.first + c);
    structure.open(fragment);
    result.opened.push_back(fragment);
}

}  // namespace sherd
