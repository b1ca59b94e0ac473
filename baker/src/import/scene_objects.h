// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <unordered_map>
#include <vector>

#include "import/line_nodes.h"
#include "import/node_recipes.h"
#include "import/node_transforms.h"

namespace sherd {

/// The nodes that show an object or, joined, make it up.
struct SceneObject {
    int node = -1;  ///< the lowest of those that show it, or the first of its parts
    NodeTransform transform;
    std::vector<int> same;    ///< further nodes that show it, ascending
    std::vector<int> joined;  ///< further nodes that are part of it
    std::vector<std::string> warnings;
};

/// Sorts mesh nodes into objects. Nodes that show one mesh at one scale and break by one recipe are
/// one object seen several times: it is broken once.
class SceneObjects {
  public:
    /// All outlive this.
    SceneObjects(const GltfSource& source, const LineNodes& lineNodes, const NodeRecipes& recipes,
                 const ImportOptions& options)
        : source_(source), lineNodes_(lineNodes), recipes_(recipes), options_(options) {}

    void add(int node, const NodeTransform& transform);
    std::vector<SceneObject>& all() { return objects_; }

  private:
    bool joinsTwin(SceneObject& object);
    std::vector<int> lineMeshes(int object) const;
    const std::vector<RecipeAnchor>& anchorsOf(int node) const;
    int meshOf(int node) const { return source_.model.nodes[static_cast<size_t>(node)].mesh; }

    const GltfSource& source_;
    const LineNodes& lineNodes_;
    const NodeRecipes& recipes_;
    const ImportOptions& options_;
    std::vector<SceneObject> objects_;
    std::unordered_map<int, std::vector<size_t>> objectsOfMesh_;
};

}  // namespace sherd
