// SPDX-License-Identifier: MIT
// Approximate convex decomposition by planes: the part with most air in its hull is cut through its
// deepest notch (J.-M. Lien and N. M. Amato, Approximate convex decomposition of polyhedra, 2007),
// by the plane after which the hulls hold least (X. Wei et al., CoACD, 2022, whose concavity looks
// at the inside, too; what lies inside a collider nobody meets); in the end parts are merged where
// that adds hardly any air (K. Mamou, V-HACD). HACD and ConvexDecomposition of Bullet's extras were
// judged and left: they count triangles, not volume, and their parts overlap.
#include "physics/convex_parts.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include "physics/cut_candidates.h"
#include "physics/vertex_clustering.h"

namespace sherd {
namespace {

/// Hulls that are only compared are found to this share of their size.
constexpr double kCompared = 5e-3;
/// Cuts hardly ever save all the air of a part: one with less than so many times what is worth it
/// is not asked.
constexpr double kAirPerWorth = 1.5;

/// Earlier candidates follow what was modelled: later ones must save that much more.
constexpr double kBetter = 1.1;
/// Half a ring has half the hull of a ring: parts filled less than this are halved even if that
/// saves nothing yet, so often at most. Merging undoes what was in vain.
constexpr double kHollow = 0.75;
constexpr uint32_t kMostIdleCuts = 2;

struct Part {
    SolidChain solid;
    Polytope hull;
    double air = 0;  ///< in the hull
    double volume = 0;
    uint32_t node = 0;
    std::vector<HalfSpace> cell;  ///< that it was cut out by
    uint32_t idleCuts = 0;        ///< of those, such as saved too little
    bool done = false;
};

/// One cut, or a part.
struct Node {
    HalfSpace wall{};
    uint32_t below = 0, beyond = 0;  ///< nodes; 0: a part
};

Part makePart(SolidChain solid, uint32_t node, std::vector<HalfSpace> cell) {
    Part part;
    part.hull = hullOf(solid.skinPoints(), kCompared);
    part.volume = solid.volume();
    part.air = volumeOf(part.hull) - part.volume;
    part.solid = std::move(solid);
    part.node = node;
    part.cell = std::move(cell);
    return part;
}

struct Cut {
    HalfSpace wall{};
    double saved = 0;     ///< of the hulls' volume
    HalfSpace halving{};  ///< across the longest axis
};

Cut bestCut(const Part& part) {
    Cut best;
    const double whole = volumeOf(part.hull);
    const std::vector<HalfSpace> candidates = cutCandidates(part.solid, part.hull);
    best.halving = candidates.back();
    for (const HalfSpace& wall : candidates) {
        const auto [below, beyond] = part.solid.splitPoints(wall);
        const Polytope a = hullOf(below, kCompared), b = hullOf(beyond, kCompared);
        if (a.empty() || b.empty()) continue;
        const double saved = whole - volumeOf(a) - volumeOf(b);
        if (saved > kBetter * best.saved) {
            best.wall = wall;
            best.saved = saved;
        }
    }
    return best;
}

HalfSpace reversed(const HalfSpace& wall) {
    return {-wall.normal, -wall.offset};
}

class Decomposition {
  public:
    Decomposition(SolidChain solid, const PartSettings& settings) : settings_(settings) {
        nodes_.emplace_back();
        parts_.push_back(makePart(std::move(solid), 0, {}));
        volume_ = parts_[0].volume;
    }

    void run() {
        while (parts_.size() < settings_.most) {
            Part* worst = nullptr;
            for (Part& part : parts_)
                if (!part.done && (worst == nullptr || part.air > worst->air)) worst = &part;
            if (worst == nullptr || worst->air < kAirPerWorth * settings_.worth * volume_) return;
            if (worst->volume > settings_.full * volumeOf(worst->hull)) {
                worst->done = true;
                continue;
            }
            const Cut cut = bestCut(*worst);
            const auto index = static_cast<size_t>(worst - parts_.data());
            if (cut.saved >= settings_.worth * volume_) {
                divide(index, cut.wall, worst->idleCuts);
            } else if (worst->volume < kHollow * volumeOf(worst->hull) &&
                       worst->idleCuts < kMostIdleCuts) {
                divide(index, cut.halving, worst->idleCuts + 1);
            } else {
                worst->done = true;
            }
        }
    }

    const std::vector<Part>& parts() const { return parts_; }
    const std::vector<Node>& nodes() const { return nodes_; }

  private:
    void divide(size_t index, const HalfSpace& wall, uint32_t idleCuts) {
        const Part part = std::move(parts_[index]);
        auto [below, beyond] = part.solid.split(wall);
        const auto first = static_cast<uint32_t>(nodes_.size());
        nodes_[part.node] = {wall, first, first + 1};
        nodes_.resize(nodes_.size() + 2);
        std::vector<HalfSpace> cell = part.cell;
        cell.push_back(wall);
        parts_[index] = makePart(std::move(below), first, cell);
        cell.back() = reversed(wall);
        parts_.push_back(makePart(std::move(beyond), first + 1, cell));
        parts_[index].idleCuts = parts_.back().idleCuts = idleCuts;
    }

    PartSettings settings_;
    std::vector<Node> nodes_;
    std::vector<Part> parts_;
    double volume_ = 0;
};

/// The corners that the skin of the whole solid has in each part, by the node it is.
void cutAlike(const SolidChain& solid, const std::vector<Node>& nodes, uint32_t node,
              std::vector<std::vector<glm::dvec3>>& cornersOfNode) {
    if (nodes[node].below == 0) {
        cornersOfNode[node].assign(solid.skinPoints().begin(), solid.skinPoints().end());
        return;
    }
    const auto [below, beyond] = solid.split(nodes[node].wall);
    cutAlike(below, nodes, nodes[node].below, cornersOfNode);
    cutAlike(beyond, nodes, nodes[node].beyond, cornersOfNode);
}

/// Where three planes meet, if they do in one point.
std::optional<glm::dvec3> meet(const HalfSpace& a, const HalfSpace& b, const HalfSpace& c) {
    const glm::dvec3 ab = glm::cross(a.normal, b.normal);
    const double det = glm::dot(ab, c.normal);
    if (std::abs(det) < 1e-6) return std::nullopt;
    return (a.offset * glm::cross(b.normal, c.normal) + b.offset * glm::cross(c.normal, a.normal) +
            c.offset * ab) /
           det;
}

/// Corners of a cell within the solid: no skin passes there.
void addInnerCorners(const SolidChain& solid, const std::vector<HalfSpace>& cell,
                     std::vector<glm::dvec3>& corners) {
    for (size_t i = 0; i < cell.size(); ++i) {
        for (size_t j = i + 1; j < cell.size(); ++j) {
            for (size_t k = j + 1; k < cell.size(); ++k) {
                const std::optional<glm::dvec3> p = meet(cell[i], cell[j], cell[k]);
                if (!p) continue;
                bool within = true;
                for (size_t l = 0; l < cell.size(); ++l)
                    within = within && (l == i || l == j || l == k ||
                                        glm::dot(cell[l].normal, *p) <= cell[l].offset);
                if (within && windingNumber(solid, *p) > 0.5) corners.push_back(*p);
            }
        }
    }
}

std::vector<glm::dvec3> together(std::vector<glm::dvec3> a, const std::vector<glm::dvec3>& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

/// A part's corners and a rough hull to compare it by.
struct Group {
    std::vector<glm::dvec3> corners;
    Polytope hull;
};

Polytope commonHull(const Group& a, const Group& b) {
    return hullOf(together(a.hull.points, b.hull.points), kCompared);
}

/// Merges parts whose common hull holds hardly more than theirs, the best first.
void mergeGroups(std::vector<Group>& groups, double worth) {
    while (groups.size() > 1) {
        double least = worth;
        size_t a = 0, b = 0;
        for (size_t i = 0; i < groups.size(); ++i) {
            for (size_t j = i + 1; j < groups.size(); ++j) {
                const double more = volumeOf(commonHull(groups[i], groups[j])) -
                                    volumeOf(groups[i].hull) - volumeOf(groups[j].hull);
                if (more >= least) continue;
                least = more;
                a = i;
                b = j;
            }
        }
        if (b == 0) return;
        groups[a] = {together(std::move(groups[a].corners), groups[b].corners),
                     commonHull(groups[a], groups[b])};
        groups.erase(groups.begin() + static_cast<std::ptrdiff_t>(b));
    }
}

}  // namespace

std::vector<std::vector<glm::dvec3>> convexParts(const SolidChain& solid,
                                                 const PartSettings& settings) {
    const bool large = solid.points().size() > settings.points;
    const SolidChain coarse = large ? clusterVertices(solid, settings.gridCells) : solid;
    Decomposition decomposition(coarse, settings);
    decomposition.run();
    std::vector<std::vector<glm::dvec3>> cornersOfNode(decomposition.nodes().size());
    cutAlike(solid, decomposition.nodes(), 0, cornersOfNode);
    std::vector<Group> groups;
    for (const Part& part : decomposition.parts()) {
        std::vector<glm::dvec3> corners = std::move(cornersOfNode[part.node]);
        addInnerCorners(coarse, part.cell, corners);
        groups.push_back({std::move(corners), part.hull});
    }
    mergeGroups(groups, 0.5 * settings.worth * solid.volume());
    std::vector<std::vector<glm::dvec3>> parts;
    for (Group& group : groups)
        if (group.corners.size() > 3) parts.push_back(std::move(group.corners));
    return parts;
}

}  // namespace sherd
