// SPDX-License-Identifier: MIT
#include "import/node_choice.h"

#include <algorithm>
#include <charconv>
#include <iterator>

namespace sherd {
namespace {

bool hasMesh(const GltfSource& source, int node) {
    return source.model.nodes[static_cast<size_t>(node)].mesh >= 0;
}

/// Mesh nodes of that name; failing that, the node of that index.
std::vector<int> nodesNamed(const GltfSource& source, const std::string& wanted) {
    const auto& nodes = source.model.nodes;
    std::vector<int> found;
    for (size_t i = 0; i < nodes.size(); ++i) {
        if (nodes[i].name == wanted && hasMesh(source, static_cast<int>(i))) {
            found.push_back(static_cast<int>(i));
        }
    }
    if (!found.empty()) return found;
    uint32_t index = 0;
    const char* end = wanted.data() + wanted.size();
    const auto [stop, error] = std::from_chars(wanted.data(), end, index);
    if (error == std::errc() && stop == end && index < nodes.size() &&
        hasMesh(source, static_cast<int>(index))) {
        found.push_back(static_cast<int>(index));
    }
    return found;
}

}  // namespace

Result<std::vector<int>> nodesOfScene(const GltfSource& source, const std::vector<int>& parents) {
    const auto& model = source.model;
    std::vector<int> nodes;
    if (model.scenes.empty()) {
        for (size_t i = 0; i < parents.size(); ++i) nodes.push_back(static_cast<int>(i));
        return nodes;
    }
    const size_t scene = model.defaultScene < 0 ? 0 : static_cast<size_t>(model.defaultScene);
    if (scene >= model.scenes.size()) {
        return fail(ErrorCode::invalidData, "the default scene does not exist",
                    source.where("/scene"));
    }
    std::vector<bool> seen(parents.size(), false);
    for (const int root : model.scenes[scene].nodes) {
        if (root < 0 || static_cast<size_t>(root) >= parents.size()) {
            return fail(ErrorCode::invalidData, "the scene names a node that does not exist",
                        source.where("/scenes/" + std::to_string(scene) + "/nodes"));
        }
        if (!seen[static_cast<size_t>(root)]) nodes.push_back(root);
        seen[static_cast<size_t>(root)] = true;
    }
    for (size_t i = 0; i < nodes.size(); ++i) {
        for (const int child : model.nodes[static_cast<size_t>(nodes[i])].children) {
            if (!seen[static_cast<size_t>(child)]) nodes.push_back(child);
            seen[static_cast<size_t>(child)] = true;
        }
    }
    std::sort(nodes.begin(), nodes.end());
    return nodes;
}

std::string listMeshNodes(const GltfSource& source) {
    constexpr int kMost = 40;
    std::string list;
    int count = 0;
    for (size_t i = 0; i < source.model.nodes.size(); ++i) {
        if (!hasMesh(source, static_cast<int>(i)) || ++count > kMost) continue;
        list += (list.empty() ? "" : ", ") + std::to_string(i);
        const std::string& name = source.model.nodes[i].name;
        if (!name.empty()) list += " \"" + name + "\"";
    }
    if (count > kMost) list += " and " + std::to_string(count - kMost) + " more";
    return list.empty() ? "none" : list;
}

std::string labelOfNode(const GltfSource& source, int node) {
    const std::string& name = source.model.nodes[static_cast<size_t>(node)].name;
    return name.empty() ? "node " + std::to_string(node) : "node \"" + name + "\"";
}

Result<std::vector<int>> chooseNodes(const GltfSource& source, const std::vector<int>& parents,
                                     const ImportOptions& options) {
    std::vector<int> chosen;
    std::vector<bool> seen(source.model.nodes.size(), false);
    for (const std::string& wanted : options.nodes) {
        const std::vector<int> found = nodesNamed(source, wanted);
        if (found.empty()) {
            return fail(
                ErrorCode::badArgument,
                "no mesh node is called \"" + wanted + "\"; the file has: " + listMeshNodes(source),
                source.where("/nodes"));
        }
        for (const int node : found) {
            if (!seen[static_cast<size_t>(node)]) chosen.push_back(node);
            seen[static_cast<size_t>(node)] = true;
        }
    }
    if (!options.nodes.empty()) return chosen;
    auto nodes = nodesOfScene(source, parents);
    if (!nodes) return nodes;
    std::copy_if(nodes->begin(), nodes->end(), std::back_inserter(chosen),
                 [&](int node) { return hasMesh(source, node); });
    if (chosen.empty()) {
        return fail(ErrorCode::noTriangles,
                    "the scene shows no mesh; mesh nodes of the file: " + listMeshNodes(source),
                    source.where("/scenes"));
    }
    return chosen;
}

}  // namespace sherd
