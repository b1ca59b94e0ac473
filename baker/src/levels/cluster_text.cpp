// SPDX-License-Identifier: MIT
// Clusters as they are written on a command line or in a recipe.
#include <algorithm>

#include "levels/piece_choice_text.h"
#include "sherd/baker/cluster.h"
#include "text_fields.h"

namespace sherd {
namespace {

constexpr uint32_t kMostGroups = 10'000;

std::optional<std::string> readKey(std::string_view part, Cluster& cluster) {
    const size_t equals = part.find('=');
    const std::string_view key = part.substr(0, equals);
    const std::string_view value =
        equals == std::string_view::npos ? std::string_view() : part.substr(equals + 1);
    if (key == "evenness") return readShare(key, value, 0, 1, cluster.evenness);
    if (std::find(kChoiceKeys.begin(), kChoiceKeys.end(), key) != kChoiceKeys.end())
        return readChoice(key, value, cluster.only);
    return quoted(key) +
           " is not known here; known are evenness, larger, name, near, smaller, within";
}

}  // namespace

Result<Cluster> parseCluster(std::string_view text) {
    const auto stop = [text](const std::string& what) {
        return fail(ErrorCode::badArgument, what, "cluster " + quoted(text));
    };
    Cluster cluster;
    cluster.text = text;
    const std::vector<std::string_view> parts = split(text, ':');
    if (!readNumber(parts[0], cluster.count) || cluster.count < 1 || cluster.count > kMostGroups)
        return stop(quoted(parts[0]) + " is not a number of groups from 1 to " +
                    std::to_string(kMostGroups));
    for (size_t k = 1; k < parts.size(); ++k)
        if (const auto wrong = readKey(parts[k], cluster)) return stop(*wrong);
    return cluster;
}

}  // namespace sherd
