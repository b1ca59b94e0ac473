// SPDX-License-Identifier: MIT
#include "surface/mesh_topology.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>
#include <tuple>

namespace sherd {
namespace {

/// A half edge at the lower vertex of its edge.
struct Use {
    uint32_t high;
    uint32_t halfEdge;
};

/// The uses of all edges by low vertex: uses[first[v]] to uses[first[v + 1]] are v's, sorted by
/// high vertex, then half edge.
struct EdgeUses {
    std::vector<uint32_t> first;
    std::vector<Use> uses;
};

bool runsForward(std::span<const std::array<uint32_t, 3>> triangles, const Use& use) {
    return triangles[use.halfEdge / 3][use.halfEdge % 3] != use.high;
}

/// Direction of the triangle beside the half edge, perpendicular to it.
glm::dvec3 apexDirection(std::span<const glm::vec3> positions,
                         const std::array<uint32_t, 3>& triangle, uint32_t k,
                         const glm::dvec3& origin, const glm::dvec3& axis) {
    const glm::dvec3 apex = glm::dvec3(positions[triangle[(k + 2) % 3]]) - origin;
    return apex - axis * glm::dot(apex, axis);
}

/// Pairs the uses of one edge: every forward one with the backward one reached first when turning
/// from it through the inside of the solid. Only which valid pairing is taken depends on floating
/// point, so closedness never does.
void pairUses(std::span<const glm::vec3> positions,
              std::span<const std::array<uint32_t, 3>> triangles, uint32_t low,
              std::span<const Use> uses, std::vector<uint32_t>& opposite) {
    const glm::dvec3 origin = positions[low];
    const glm::dvec3 along = glm::dvec3(positions[uses[0].high]) - origin;
    const double length = glm::length(along);
    const glm::dvec3 axis = length > 0 ? along / length : glm::dvec3(1, 0, 0);
    struct Candidate {
        double angle;
        uint32_t forward, backward;
        bool operator<(const Candidate& o) const {
            return std::tie(angle, forward, backward) < std::tie(o.angle, o.forward, o.backward);
        }
    };
    std::vector<Candidate> candidates;
    for (const Use& f : uses) {
        if (!runsForward(triangles, f)) continue;
        const glm::dvec3 x =
            apexDirection(positions, triangles[f.halfEdge / 3], f.halfEdge % 3, origin, axis);
        const glm::dvec3 y = glm::cross(axis, x);
        for (const Use& b : uses) {
            if (runsForward(triangles, b)) continue;
            const glm::dvec3 d =
                apexDirection(positions, triangles[b.halfEdge / 3], b.halfEdge % 3, origin, axis);
            // The face beside a forward half edge has its normal axis x apex, so inside is turning
            // against it, from -y.
            double angle = std::atan2(-glm::dot(d, y), glm::dot(d, x));
            if (angle <= 0) angle += 2 * M_PI;
            candidates.push_back({angle, f.halfEdge, b.halfEdge});
        }
    }
    std::sort(candidates.begin(), candidates.end());
    for (const Candidate& c : candidates) {
        if (opposite[c.forward] != kNone || opposite[c.backward] != kNone) continue;
        opposite[c.forward] = c.backward;
        opposite[c.backward] = c.forward;
    }
}

/// A counting sort on the low vertex: linear, and stable in the half edge. The few uses of each
/// vertex are sorted by insertion.
EdgeUses collectUses(std::span<const std::array<uint32_t, 3>> triangles, size_t vertexCount,
                     std::vector<uint8_t>& degenerate) {
    EdgeUses result;
    result.first.assign(vertexCount + 2, 0);
    for (uint32_t t = 0; t < triangles.size(); ++t) {
        const auto [a, b, c] = triangles[t];
        degenerate[t] = a == b || b == c || c == a;
        if (degenerate[t] != 0) continue;
        ++result.first[std::min(a, b) + 2];
        ++result.first[std::min(b, c) + 2];
        ++result.first[std::min(c, a) + 2];
    }
    std::partial_sum(result.first.begin(), result.first.end(), result.first.begin());
    result.uses.resize(result.first.back());
    // first[v + 1] runs from where v's uses start to where they end.
    for (uint32_t t = 0; t < triangles.size(); ++t) {
        if (degenerate[t] != 0) continue;
        const auto& v = triangles[t];
        for (uint32_t k = 0; k < 3; ++k) {
            const auto [low, high] = std::minmax(v[k], v[k == 2 ? 0 : k + 1]);
            result.uses[result.first[low + 1]++] = {high, 3 * t + k};
        }
    }
    const auto before = [](const Use& x, const Use& y) {
        return x.high != y.high ? x.high < y.high : x.halfEdge < y.halfEdge;
    };
    for (size_t v = 0; v < vertexCount; ++v) {
        const auto first = result.uses.begin() + result.first[v];
        const auto last = result.uses.begin() + result.first[v + 1];
        if (last - first > 32) {
            std::sort(first, last, before);
            continue;
        }
        for (auto i = first; i != last; ++i) {
            const Use use = *i;
            auto hole = i;
            for (; hole != first && before(use, hole[-1]); --hole) *hole = hole[-1];
            *hole = use;
        }
    }
    return result;
}

}  // namespace

MeshTopology buildTopology(std::span<const glm::vec3> positions,
                           std::span<const std::array<uint32_t, 3>> triangles) {
    MeshTopology topology;
    topology.degenerate.assign(triangles.size(), 0);
    topology.halfEdgeEdge.assign(triangles.size() * 3, kNone);
    topology.opposite.assign(triangles.size() * 3, kNone);
    const EdgeUses all = collectUses(triangles, positions.size(), topology.degenerate);
    const std::vector<Use>& uses = all.uses;
    topology.edges.reserve(uses.size() / 2 + uses.size() / 64);
    uint32_t low = 0;
    for (size_t i = 0; i < uses.size();) {
        while (all.first[low + 1] <= i) ++low;
        size_t end = i;
        uint32_t forward = 0;
        const auto edge = static_cast<uint32_t>(topology.edges.size());
        while (end < all.first[low + 1] && uses[end].high == uses[i].high) {
            topology.halfEdgeEdge[uses[end].halfEdge] = edge;
            forward += runsForward(triangles, uses[end++]) ? 1 : 0;
        }
        const auto count = static_cast<uint32_t>(end - i);
        topology.edges.push_back({low, uses[i].high});

        if (count == 2 && forward == 1) {
            topology.opposite[uses[i].halfEdge] = uses[i + 1].halfEdge;
            topology.opposite[uses[i + 1].halfEdge] = uses[i].halfEdge;
        } else if (count == 1) {
            ++topology.boundaryEdges;
            if (topology.firstBoundaryHalfEdge == kNone) {
                topology.firstBoundaryHalfEdge = uses[i].halfEdge;
            }
        } else {
            if (2 * forward == count) {
                ++topology.pinchedEdges;
            } else {
                ++topology.nonManifoldEdges;
                if (topology.firstNonManifoldHalfEdge == kNone) {
                    topology.firstNonManifoldHalfEdge = uses[i].halfEdge;
                }
            }
            pairUses(positions, triangles, low, std::span(uses).subspan(i, count),
                     topology.opposite);
        }
        i = end;
    }
    return topology;
}

}  // namespace sherd
