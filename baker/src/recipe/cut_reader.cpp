// SPDX-License-Identifier: MIT
#include "recipe/cut_reader.h"

#include "recipe/choice_reader.h"

namespace sherd {
namespace {

using Json = nlohmann::json;

bool readDrawn(RecipeReader& reader, const Json& json, const std::string& pointer, VolumeCut& cut) {
    std::string map, axis;
    PieceChoice& only = cut.only;
    if (!reader.object(
            json, pointer,
            {{"map", reader.string(map)},
             {"axis", reader.word(axis, {"x", "y", "z", "-x", "-y", "-z"})},
             {"larger", reader.number(only.larger, 0, 1)},
             {"smaller", reader.number(only.smaller, 0, 1)},
             {"near", [&](const Json& j,
                          const std::string& p) { return readPlaces(reader, j, p, only.near); }},
             {"within", reader.number(only.within, 0, kFarthestPlace)},
             {"name", reader.string(only.name)}}))
        return false;
    if (map.empty())
        return reader.wrong(pointer,
                            "needs a \"map\", the path of a drawing (SVG, JSON, PNG, JPEG)");
    if (json.contains("name") && only.name.empty())
        return reader.wrong(pointer + "/name", "must be the name of a piece, as a label says it");
    if (only.within > 0 && only.near.empty())
        return reader.wrong(pointer + "/within", "needs a point to be \"near\"");
    cut.kind = VolumeCut::Kind::map;
    cut.map = map;
    if (!axis.empty()) cut.along[axis.back() - 'x'] = axis.size() > 1 ? -1 : 1;
    cut.text = "map:" + map;  // for reports; what it was asked for beside that stands in the recipe
    if (!axis.empty()) cut.text += ":axis=" + axis;
    return true;
}

}  // namespace

bool readCut(RecipeReader& reader, const Json& json, const std::string& pointer,
             std::optional<VolumeCut>& cut) {
    cut.emplace();
    if (json.is_string()) {
        Result<VolumeCut> parsed = parseVolumeCut(json.get<std::string>());
        if (!parsed) return reader.wrong(pointer, ": " + parsed.error().message);
        cut = std::move(*parsed);
    } else if (!json.is_object()) {
        return reader.wrong(pointer,
                            "must be a text like \"voronoi:12\", or an object with a \"map\" that "
                            "cuts straight through");
    } else if (!readDrawn(reader, json, pointer, *cut)) {
        return false;
    }
    cut->where = reader.place(pointer);
    return true;
}

}  // namespace sherd
