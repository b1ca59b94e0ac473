// SPDX-License-Identifier: MIT
#include "import/unit_scale.h"

#include <nlohmann/json.hpp>
#include <set>

namespace sherd {
namespace {

using OrderedJson = nlohmann::ordered_json;

/// Marks the node, so that a bake of a bake is not scaled twice.
const char* const kMark = "sherdUnitScale";

bool isUnitNode(const OrderedJson& node) {
    return node.is_object() && node.contains("extras") && node["extras"].is_object() &&
           node["extras"].contains(kMark);
}

OrderedJson unitNode(double metres, const OrderedJson& roots) {
    return {{"name", "unit scale"},
            {"scale", {metres, metres, metres}},
            {"children", roots},
            {"extras", {{kMark, metres}}}};
}

/// The nodes of a document without scenes that no other node has for a child.
OrderedJson rootsOf(const OrderedJson& nodes) {
    std::set<size_t> children;
    for (const OrderedJson& node : nodes) {
        if (!node.is_object() || !node.contains("children")) continue;
        for (const OrderedJson& child : node["children"])
            if (child.is_number_unsigned()) children.insert(child.get<size_t>());
    }
    OrderedJson roots = OrderedJson::array();
    for (size_t i = 0; i < nodes.size(); ++i)
        if (children.count(i) == 0) roots.push_back(i);
    return roots;
}

/// Whether a scene's nodes are lists, as far as they are needed here; and of no scene before.
Result<void> checkRoots(const OrderedJson& scene, const std::string& where,
                        std::set<size_t>& seen) {
    const auto roots = scene.is_object() ? scene.find("nodes") : scene.end();
    if (!scene.is_object()) return fail(ErrorCode::invalidData, "expected an object", where);
    if (roots == scene.end()) return {};
    if (!roots->is_array()) return fail(ErrorCode::invalidData, "expected an array", where);
    std::set<size_t> own;
    for (const OrderedJson& root : *roots) {
        if (!root.is_number_unsigned())
            return fail(ErrorCode::invalidData, "expected the number of a node", where);
        own.insert(root.get<size_t>());
    }
    for (const size_t root : own) {
        if (seen.insert(root).second) continue;
        return fail(ErrorCode::unsupported,
                    "two scenes share node " + std::to_string(root) +
                        ", so none can be scaled alone; export one scene, or scale the model",
                    where);
    }
    return {};
}

}  // namespace

Result<void> scaleScenes(GltfDocument& document, const std::string& name, double metres) {
    OrderedJson json = OrderedJson::parse(document.json, nullptr, false);
    if (!json.is_object() || !json.contains("nodes") || !json["nodes"].is_array())
        return fail(ErrorCode::invalidData, "the document has no nodes", name + "#/nodes");
    OrderedJson& nodes = json["nodes"];
    bool scaled = false;
    for (OrderedJson& node : nodes) {
        if (!isUnitNode(node)) continue;
        node["scale"] = {metres, metres, metres};
        node["extras"][kMark] = metres;
        scaled = true;
    }
    const bool scenes = json.contains("scenes") && json["scenes"].is_array();
    if (!scaled && metres != 1 && !scenes) nodes.push_back(unitNode(metres, rootsOf(nodes)));
    if (!scaled && metres != 1 && scenes) {
        std::set<size_t> seen;
        for (size_t i = 0; i < json["scenes"].size(); ++i) {
            OrderedJson& scene = json["scenes"][i];
            const std::string where = name + "#/scenes/" + std::to_string(i) + "/nodes";
            if (auto ok = checkRoots(scene, where, seen); !ok) return ok;
            if (!scene.contains("nodes") || scene["nodes"].empty()) continue;
            nodes.push_back(unitNode(metres, scene["nodes"]));
            scene["nodes"] = {nodes.size() - 1};
        }
    }
    document.json = json.dump(-1, ' ', false, OrderedJson::error_handler_t::replace);
    return {};
}

}  // namespace sherd
