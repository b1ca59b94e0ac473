// SPDX-License-Identifier: MIT
#include "extension_nodes.h"

#include "extension_name.h"

namespace sherd {
namespace {

using nlohmann::json;

/// A node belongs to one object at most, and once.
void checkNodeUse(ExtensionReader& in, const json& document, const std::vector<FractureSet>& sets) {
    const json* nodes = ExtensionReader::optional(document, "nodes");
    std::vector<bool> used(nodes != nullptr && nodes->is_array() ? nodes->size() : 0, false);
    for (const FractureSet& set : sets) {
        if (set.node >= 0) used[static_cast<size_t>(set.node)] = true;
        for (const int32_t node : set.sameNodes) used[static_cast<size_t>(node)] = true;
    }
    for (size_t s = 0; s < sets.size(); ++s) {
        const std::string where = "/extensions/" + std::string(kExtensionName) + "/fractures/" +
                                  std::to_string(s) + "/joined";
        if (!sets[s].joinedNodes.empty() && !sets[s].sameNodes.empty())
            return in.fail(ErrorCode::invalidData,
                           "an object of several nodes can be carried by one of them only", where);
        for (size_t j = 0; j < sets[s].joinedNodes.size(); ++j) {
            const auto node = static_cast<size_t>(sets[s].joinedNodes[j]);
            if (used[node])
                return in.fail(ErrorCode::invalidData,
                               "node " + std::to_string(node) + " is part of an object already",
                               where + "/" + std::to_string(j));
            used[node] = true;
        }
    }
}

/// The nodes that carry each fracture, the first one apart.
void findNodes(ExtensionReader& in, const json& document, std::vector<FractureSet>& sets) {
    const json* nodes = ExtensionReader::optional(document, "nodes");
    for (size_t n = 0; nodes != nullptr && nodes->is_array() && n < nodes->size(); ++n) {
        const json* extensions = ExtensionReader::optional((*nodes)[n], "extensions");
        const json* ours = extensions != nullptr
                               ? ExtensionReader::optional(*extensions, kExtensionName)
                               : nullptr;
        if (ours == nullptr) continue;
        const std::string where =
            "/nodes/" + std::to_string(n) + "/extensions/" + std::string(kExtensionName);
        const uint64_t index = in.whole(*ours, "fracture", where);
        if (in.ok() && index >= sets.size())
            in.fail(ErrorCode::invalidData, "there is no such fracture", where + "/fracture");
        if (!in.ok()) return;
        if (sets[index].node < 0)
            sets[index].node = static_cast<int32_t>(n);
        else
            sets[index].sameNodes.push_back(static_cast<int32_t>(n));
    }
    for (size_t s = 0; s < sets.size(); ++s)
        if (sets[s].node < 0)
            in.fail(
                ErrorCode::invalidData, "no node carries this fracture",
                "/extensions/" + std::string(kExtensionName) + "/fractures/" + std::to_string(s));
}

}  // namespace

void readNodes(ExtensionReader& in, const json& document, std::vector<FractureSet>& sets) {
    findNodes(in, document, sets);
    if (in.ok()) checkNodeUse(in, document, sets);
}

}  // namespace sherd
