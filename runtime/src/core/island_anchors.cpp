// SPDX-License-Identifier: MIT
// What holds islands of an IslandWorld to the world.
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

#include "core/rigid_pose.h"
#include "sherd/runtime/island_world.h"

namespace sherd {
namespace {

/// Around a fragment's colliders where `pose` puts them.
Asset::Box boxAt(const Asset& asset, uint32_t fragment, const RigidPose& pose) {
    const FractureSet& set = asset.set();
    const Range hulls = asset.fragment(fragment).hulls;
    Asset::Box box{glm::vec3(HUGE_VALF), glm::vec3(-HUGE_VALF)};
    for (uint32_t h = hulls.first; h < hulls.first + hulls.count; ++h) {
        const ConvexHull& hull = set.hulls[h];
        for (uint32_t p = hull.points.first; p < hull.points.first + hull.points.count; ++p) {
            const glm::vec3 point = pose * set.hullPoints[p];
            box.low = glm::min(box.low, point - hull.margin);
            box.high = glm::max(box.high, point + hull.margin);
        }
    }
    return box;
}

}  // namespace

uint32_t IslandWorld::pinInBox(uint32_t index, const glm::vec3& low, const glm::vec3& high) {
    const Asset& asset = *objects_[index].asset;
    const BondGraph& graph = asset.graph();
    Vector<uint32_t> found;
    for (const uint32_t i : objects_[index].islands)
        for (const uint32_t fragment : islands_[i].fragments) {
            const Range leaves = graph.leavesOf(fragment);
            for (uint32_t leaf = leaves.first; leaf < leaves.first + leaves.count; ++leaf) {
                const Asset::Box box = boxAt(asset, graph.fragmentOfLeaf(leaf), islands_[i].pose);
                if (glm::all(glm::lessThanEqual(box.low, high)) &&
                    glm::all(glm::lessThanEqual(low, box.high)))
                    found.push_back(leaf);
            }
        }
    pin(index, found, true);
    return uint32_t(found.size());
}

}  // namespace sherd
