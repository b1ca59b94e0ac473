// SPDX-License-Identifier: MIT
// What holds islands of an IslandWorld to the world.
#include <glm/vector_relational.hpp>

#include "sherd/runtime/island_world.h"

namespace sherd {
uint32_t IslandWorld::pinInBox(uint32_t index, const glm::vec3& low, const glm::vec3& high) {
    const Asset& asset = *objects_[index].asset;
    const BondGraph& graph = asset.graph();
    Vector<uint32_t> found;
    for (const uint32_t i : objects_[index].islands) {
        const RigidPose& place = placesOf(i).now;
        for (const uint32_t fragment : islands_[i].fragments) {
            const Range leaves = graph.leavesOf(fragment);
            for (uint32_t leaf = leaves.first; leaf < leaves.first + leaves.count; ++leaf) {
                const Asset::Box box = asset.boxAt(graph.fragmentOfLeaf(leaf), place);
                if (glm::all(glm::lessThanEqual(box.low, high)) &&
                    glm::all(glm::lessThanEqual(low, box.high)))
                    found.push_back(leaf);
            }
        }
    }
    pin(index, found, true);
    return uint32_t(found.size());
}

}  // namespace sherd
