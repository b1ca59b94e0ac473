// SPDX-License-Identifier: MIT
#include "import/scene_objects.h"

#include <algorithm>

#include "import/node_choice.h"

namespace sherd {

void SceneObjects::add(int node, const NodeTransform& transform) {
    if (join_ && !objects_.empty()) {
        objects_.front().joined.push_back(node);
        return;
    }
    SceneObject object{node, transform, {}, {}, {}};
    if (joinsTwin(object)) return;
    objectsOfMesh_[meshOf(node)].push_back(objects_.size());
    objects_.push_back(std::move(object));
}

/// Whether an object there already is the same, seen elsewhere. Says why not, if it is nearly.
bool SceneObjects::joinsTwin(SceneObject& object) {
    const auto found = objectsOfMesh_.find(meshOf(object.node));
    if (found == objectsOfMesh_.end()) return false;
    const char* reason = "at another scale";
    for (const size_t i : found->second) {
        SceneObject& other = objects_[i];
        if (other.transform.deform != object.transform.deform) continue;
        if (lineMeshes(other.node) != lineMeshes(object.node)) {
            reason = "with other lines below it";
            continue;
        }
        int further = object.node;
        // A reader takes the pose of a fracture set for that of the lowest node carrying it.
        if (further < other.node) {
            std::swap(further, other.node);
            other.transform = object.transform;
        }
        other.same.insert(std::lower_bound(other.same.begin(), other.same.end(), further), further);
        return true;
    }
    object.warnings.push_back(labelOfNode(source_, object.node) + " shows the same mesh as " +
                              labelOfNode(source_, objects_[found->second.front()].node) + " " +
                              reason + "; it is broken separately");
    return false;
}

/// The meshes of the line nodes below an object.
std::vector<int> SceneObjects::lineMeshes(int object) const {
    std::vector<int> meshes;
    const auto found = lineNodes_.below.find(object);
    if (found == lineNodes_.below.end()) return meshes;
    for (const int line : found->second) meshes.push_back(meshOf(line));
    return meshes;
}

}  // namespace sherd
