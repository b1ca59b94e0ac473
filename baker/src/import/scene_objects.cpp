// SPDX-License-Identifier: MIT
#include "import/scene_objects.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "import/node_choice.h"

namespace sherd {

namespace {

/// Whether a plane of the scene looks the same from two objects.
bool looksAlike(const glm::dvec3& point, const glm::dvec3& normal, const NodeTransform& a,
                const NodeTransform& b) {
    const glm::dvec3 seenA = glm::inverse(a.rotation) * normal;
    const glm::dvec3 seenB = glm::inverse(b.rotation) * normal;
    const double heightA = glm::dot(normal, a.translation - point);
    const double heightB = glm::dot(normal, b.translation - point);
    return glm::distance(seenA, seenB) < 1e-6 &&
           std::abs(heightA - heightB) < 1e-6 * (1 + std::abs(heightA));
}

bool heldAlike(const std::vector<RecipeAnchor>& anchors, const NodeTransform& a,
               const NodeTransform& b) {
    return std::all_of(anchors.begin(), anchors.end(), [&](const RecipeAnchor& anchor) {
        if (anchor.kind == RecipeAnchor::Kind::label) return true;
        if (anchor.kind == RecipeAnchor::Kind::below)
            return looksAlike(anchor.point, glm::normalize(anchor.normal), a, b);
        bool alike = true;
        for (int k = 0; k < 3; ++k) {
            glm::dvec3 axis(0.0);
            axis[k] = 1;
            alike = alike && looksAlike(anchor.low, axis, a, b);
        }
        return alike;
    });
}

}  // namespace

void SceneObjects::add(int node, const NodeTransform& transform) {
    if (options_.join && !objects_.empty()) {
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
        if (recipes_.of(other.node) != recipes_.of(object.node)) {
            reason = "by another recipe";
            continue;
        }
        if (!heldAlike(anchorsOf(object.node), other.transform, object.transform)) {
            reason = "where anchors hold it otherwise";
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

const std::vector<RecipeAnchor>& SceneObjects::anchorsOf(int node) const {
    const int32_t own = recipes_.of(node);
    return own < 0 ? options_.anchors : recipes_.recipes[static_cast<size_t>(own)].anchors;
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
