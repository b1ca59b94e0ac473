// SPDX-License-Identifier: MIT
#include "surface/part_groups.h"

#include <algorithm>
#include <glm/common.hpp>
#include <limits>

#include "geometry/inside_test.h"
#include "geometry/triangle_bvh.h"
#include "geometry/triangle_contact.h"
#include "geometry/union_find.h"

namespace sherd {
namespace {

/// Numbers roots from 0 in the order of triangles.
uint32_t number(UnionFind& sets, uint32_t count, std::vector<uint32_t>& label) {
    label.assign(count, kNone);
    std::vector<uint32_t> numberOf(count, kNone);
    uint32_t numbers = 0;
    for (uint32_t t = 0; t < count; ++t) {
        uint32_t& n = numberOf[sets.find(t)];
        if (n == kNone) n = numbers++;
        label[t] = n;
    }
    return numbers;
}

struct Box {
    glm::vec3 low{std::numeric_limits<float>::max()};
    glm::vec3 high{std::numeric_limits<float>::lowest()};
    bool meets(const glm::vec3& otherLow, const glm::vec3& otherHigh) const {
        for (int k = 0; k < 3; ++k)
            if (low[k] > otherHigh[k] || high[k] < otherLow[k]) return false;
        return true;
    }
    bool holds(const Box& other) const {
        for (int k = 0; k < 3; ++k)
            if (low[k] > other.low[k] || high[k] < other.high[k]) return false;
        return true;
    }
    void add(const glm::vec3& p) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
};

class Grouper {
  public:
    Grouper(const SurfaceMesh& mesh, const std::vector<uint32_t>& part, uint32_t parts)
        : mesh_(mesh), part_(part), boxes_(parts), groups_(parts) {
        for (uint32_t t = 0; t < part.size(); ++t)
            for (const uint32_t v : mesh.triangles[t]) boxes_[part[t]].add(mesh.positions[v]);
    }

    UnionFind run() {
        uniteTouching();
        uniteContained();
        return std::move(groups_);
    }

  private:
    std::array<glm::dvec3, 3> cornersOf(uint32_t t) const {
        const auto& v = mesh_.triangles[t];
        return {mesh_.positions[v[0]], mesh_.positions[v[1]], mesh_.positions[v[2]]};
    }

    void uniteTouching() {
        const TriangleBvh tree(mesh_.positions, mesh_.triangles);
        for (uint32_t t = 0; t < part_.size(); ++t) {
            Box box;
            for (const uint32_t v : mesh_.triangles[t]) box.add(mesh_.positions[v]);
            const auto wants = [&](const glm::vec3& low, const glm::vec3& high) {
                return box.meets(low, high);
            };
            tree.forEach(wants, [&](uint32_t other, const auto& corners) {
                if (part_[other] == part_[t]) return;
                if (groups_.find(part_[other]) == groups_.find(part_[t])) return;
                const std::array<glm::dvec3, 3> there{corners[0], corners[1], corners[2]};
                if (trianglesTouch(cornersOf(t), there)) groups_.unite(part_[t], part_[other]);
            });
        }
    }

    /// Parts that touch nothing may still lie inside one: any vertex tells.
    void uniteContained() {
        std::vector<uint32_t> anyTriangle(boxes_.size());
        std::vector<std::vector<std::array<uint32_t, 3>>> triangles(boxes_.size());
        for (uint32_t t = 0; t < part_.size(); ++t) {
            anyTriangle[part_[t]] = t;
            triangles[part_[t]].push_back(mesh_.triangles[t]);
        }
        for (uint32_t outer = 0; outer < boxes_.size(); ++outer) {
            std::vector<uint32_t> candidates;
            for (uint32_t inner = 0; inner < boxes_.size(); ++inner) {
                if (inner != outer && boxes_[outer].holds(boxes_[inner]))
                    candidates.push_back(inner);
            }
            if (candidates.empty()) continue;
            const InsideTest test(mesh_.positions, triangles[outer]);
            for (const uint32_t inner : candidates) {
                const uint32_t v = mesh_.triangles[anyTriangle[inner]][0];
                // A shell turned inwards is the hollow of what is around it.
                if (test.winding(mesh_.positions[v]) != 0) groups_.unite(inner, outer);
            }
        }
    }

    const SurfaceMesh& mesh_;
    const std::vector<uint32_t>& part_;
    std::vector<Box> boxes_;
    UnionFind groups_;  ///< over parts
};

}  // namespace

PartGroups groupParts(const SurfaceMesh& mesh, const MeshTopology& topology) {
    const auto count = static_cast<uint32_t>(mesh.triangles.size());
    UnionFind connected(count);
    for (uint32_t h = 0; h < 3 * count; ++h) {
        if (topology.opposite[h] != kNone) connected.unite(h / 3, topology.opposite[h] / 3);
    }
    // Degenerate triangles are no part of their own: cutting drops them.
    const auto sound =
        static_cast<uint32_t>(std::find(topology.degenerate.begin(), topology.degenerate.end(), 0) -
                              topology.degenerate.begin());
    for (uint32_t t = 0; t < count; ++t)
        if (topology.degenerate[t] != 0 && sound < count) connected.unite(t, sound);
    PartGroups result;
    result.parts = number(connected, count, result.part);
    if (result.parts == 1) {
        result.group.assign(count, 0);
        result.groups = 1;
        return result;
    }
    UnionFind groups = Grouper(mesh, result.part, result.parts).run();
    std::vector<uint32_t> groupOfPart;
    result.groups = number(groups, result.parts, groupOfPart);
    result.group.reserve(count);
    for (const uint32_t part : result.part) result.group.push_back(groupOfPart[part]);
    return result;
}

}  // namespace sherd
