// SPDX-License-Identifier: MIT
#include "recipe/level_reader.h"

#include <algorithm>

#include "recipe/choice_reader.h"
#include "recipe/cut_reader.h"

namespace sherd {
namespace {

/// What a level says beside its text, which may say it, too.
bool takeChoice(RecipeReader& reader, const std::string& pointer, const std::string& what,
                const RecipeLevel& level, PieceChoice& only) {
    if (level.only.all()) return true;
    if (!only.all())
        return reader.wrong(pointer + "/only",
                            "chooses pieces, and so does the " + what + "'s text; say it once");
    only = level.only;
    return true;
}

}  // namespace

bool readLevels(RecipeReader& reader, const nlohmann::json& json, const std::string& pointer,
                Recipe& recipe) {
    if (!json.is_array() || json.empty())
        return reader.wrong(pointer, "must be a list with at least one level");
    for (size_t i = 0; i < json.size(); ++i) {
        RecipeLevel level;
        std::string map, pattern, cluster, projection;
        const std::string here = pointer + "/" + std::to_string(i);
        if (!reader.object(
                json[i], here,
                {{"map", reader.string(map)},
                 {"pattern", reader.string(pattern)},
                 {"cut", [&](const nlohmann::json& j,
                             const std::string& p) { return readCut(reader, j, p, level.cut); }},
                 {"cluster", reader.string(cluster)},
                 {"projection", reader.string(projection)},
                 {"strength", reader.number(level.strength, 0, 1e15)},
                 {"toughness", reader.number(level.toughness, 0, 1e15)},
                 {"only",
                  [&](const nlohmann::json& j, const std::string& p) {
                      return readChoice(reader, j, p, level.only);
                  }},
                 {"name", reader.string(level.name)}}))
            return false;
        if ((map.empty() ? 0 : 1) + (pattern.empty() ? 0 : 1) + (level.cut ? 1 : 0) +
                (cluster.empty() ? 0 : 1) !=
            1)
            return reader.wrong(
                here,
                "needs one of a \"map\", the path of a drawing (SVG, JSON, PNG, "
                "JPEG), a \"pattern\" like \"voronoi:12\", a \"cut\" through the "
                "volume like \"voronoi:12\", and a \"cluster\" of finer pieces like \"8\"");
        level.map = map;
        if (!pattern.empty()) {
            Result<Pattern> parsed = parsePattern(pattern);
            if (!parsed) return reader.wrong(here + "/pattern", ": " + parsed.error().message);
            level.pattern = std::move(*parsed);
        }
        if (level.cut && !takeChoice(reader, here, "cut", level, level.cut->only)) return false;
        if (!cluster.empty()) {
            Result<Cluster> parsed = parseCluster(cluster);
            if (!parsed) return reader.wrong(here + "/cluster", ": " + parsed.error().message);
            level.cluster = std::move(*parsed);
            level.cluster->where = reader.place(here + "/cluster");
            if (!takeChoice(reader, here, "cluster", level, level.cluster->only)) return false;
        }
        if (!projection.empty()) {
            const Result<Projection> parsed = parseProjection(projection);
            if (!parsed) return reader.wrong(here + "/projection", ": " + parsed.error().message);
            level.projection = *parsed;
        }
        level.where = reader.place(here);
        recipe.levels.push_back(level);
    }
    if (endsInCluster(recipe.levels)) {
        return reader.wrong(pointer + "/" + std::to_string(json.size() - 1) + "/cluster",
                            "has nothing to group: a finer level must come behind it");
    }
    return true;
}

bool endsInCluster(const std::vector<RecipeLevel>& levels) {
    // Clusters alone may group what lines modelled on the object make.
    return !levels.empty() && levels.back().cluster &&
           std::any_of(levels.begin(), levels.end(),
                       [](const RecipeLevel& level) { return !level.cluster; });
}

}  // namespace sherd
