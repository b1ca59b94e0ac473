// SPDX-License-Identifier: MIT
#include "recipe/level_reader.h"

#include "recipe/choice_reader.h"

namespace sherd {

bool readLevels(RecipeReader& reader, const nlohmann::json& json, const std::string& pointer,
                Recipe& recipe) {
    if (!json.is_array() || json.empty())
        return reader.wrong(pointer, "must be a list with at least one level");
    for (size_t i = 0; i < json.size(); ++i) {
        RecipeLevel level;
        std::string map, pattern, cut, projection;
        const std::string here = pointer + "/" + std::to_string(i);
        if (!reader.object(json[i], here,
                           {{"map", reader.string(map)},
                            {"pattern", reader.string(pattern)},
                            {"cut", reader.string(cut)},
                            {"projection", reader.string(projection)},
                            {"strength", reader.number(level.strength, 0, 1e15)},
                            {"toughness", reader.number(level.toughness, 0, 1e15)},
                            {"only",
                             [&](const nlohmann::json& j, const std::string& p) {
                                 return readChoice(reader, j, p, level.only);
                             }},
                            {"name", reader.string(level.name)}}))
            return false;
        if ((map.empty() ? 0 : 1) + (pattern.empty() ? 0 : 1) + (cut.empty() ? 0 : 1) != 1)
            return reader.wrong(
                here,
                "needs one of a \"map\", the path of a drawing (SVG, JSON, PNG, "
                "JPEG), a \"pattern\" like \"voronoi:12\", and a \"cut\" through the "
                "volume like \"voronoi:12\"");
        level.map = map;
        if (!pattern.empty()) {
            Result<Pattern> parsed = parsePattern(pattern);
            if (!parsed) return reader.wrong(here + "/pattern", ": " + parsed.error().message);
            level.pattern = std::move(*parsed);
        }
        if (!cut.empty()) {
            Result<VolumeCut> parsed = parseVolumeCut(cut);
            if (!parsed) return reader.wrong(here + "/cut", ": " + parsed.error().message);
            level.cut = std::move(*parsed);
            level.cut->where = reader.place(here + "/cut");
            if (!level.only.all() && !level.cut->only.all())
                return reader.wrong(here + "/only",
                                    "chooses pieces, and so does the cut's text; say it once");
            if (!level.only.all()) level.cut->only = level.only;
        }
        if (!projection.empty()) {
            const Result<Projection> parsed = parseProjection(projection);
            if (!parsed) return reader.wrong(here + "/projection", ": " + parsed.error().message);
            level.projection = *parsed;
        }
        recipe.levels.push_back(level);
    }
    return true;
}

}  // namespace sherd
