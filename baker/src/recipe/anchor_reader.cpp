// SPDX-License-Identifier: MIT
#include "recipe/anchor_reader.h"

#include <glm/geometric.hpp>

namespace sherd {
namespace {

using Json = nlohmann::json;

/// A height along y, or a point with the direction upwards.
bool readBelow(RecipeReader& reader, const Json& json, const std::string& pointer,
               RecipeAnchor& anchor) {
    anchor.kind = RecipeAnchor::Kind::below;
    if (json.is_number())
        return reader.number(anchor.point.y, -kFarthestPlace, kFarthestPlace)(json, pointer);
    if (!json.is_object())
        return reader.wrong(pointer,
                            "must be a height along y in metres, or an object with a \"point\" and "
                            "a \"normal\"");
    if (!reader.object(json, pointer,
                       {{"point", reader.vector(anchor.point, -kFarthestPlace, kFarthestPlace)},
                        {"normal", reader.vector(anchor.normal, -1e6, 1e6)}}))
        return false;
    if (!json.contains("point"))
        return reader.wrong(pointer, "needs a \"point\" [x, y, z] on the plane");
    if (!(glm::length(anchor.normal) > 1e-6))
        return reader.wrong(pointer + "/normal", "must not be zero: it points upwards");
    return true;
}

bool readBox(RecipeReader& reader, const Json& json, const std::string& pointer,
             RecipeAnchor& anchor) {
    anchor.kind = RecipeAnchor::Kind::box;
    if (!reader.object(json, pointer,
                       {{"min", reader.vector(anchor.low, -kFarthestPlace, kFarthestPlace)},
                        {"max", reader.vector(anchor.high, -kFarthestPlace, kFarthestPlace)}}))
        return false;
    if (!json.contains("min") || !json.contains("max"))
        return reader.wrong(pointer, "needs a \"min\" and a \"max\" corner [x, y, z]");
    for (int k = 0; k < 3; ++k)
        if (anchor.low[k] > anchor.high[k])
            return reader.wrong(pointer + "/max", "must be at least \"min\" along x, y and z");
    return true;
}

bool readLabel(RecipeReader& reader, const Json& json, const std::string& pointer,
               RecipeAnchor& anchor) {
    anchor.kind = RecipeAnchor::Kind::label;
    if (!reader.string(anchor.label)(json, pointer)) return false;
    return !anchor.label.empty() || reader.wrong(pointer, "must be the name of a piece");
}

bool readAnchor(RecipeReader& reader, const Json& json, const std::string& pointer,
                RecipeAnchor& anchor) {
    int places = 0;
    const auto place = [&](bool (*read)(RecipeReader&, const Json&, const std::string&,
                                        RecipeAnchor&)) -> RecipeReader::Field {
        return [&reader, &anchor, &places, read](const Json& j, const std::string& p) {
            ++places;
            return read(reader, j, p, anchor);
        };
    };
    if (!reader.object(json, pointer,
                       {{"below", place(readBelow)},
                        {"box", place(readBox)},
                        {"label", place(readLabel)},
                        {"strength", reader.number(anchor.strength, 0, 1e15)},
                        {"toughness", reader.number(anchor.toughness, 0, 1e15)}}))
        return false;
    if (places != 1) {
        return reader.wrong(pointer,
                            "needs one of \"below\", a height along y or a plane, \"box\", and "
                            "\"label\", the name of a piece");
    }
    anchor.where = reader.place(pointer);
    return true;
}

}  // namespace

bool readAnchors(RecipeReader& reader, const Json& json, const std::string& pointer,
                 std::vector<RecipeAnchor>& anchors) {
    if (!json.is_array() || json.empty())
        return reader.wrong(pointer, "must be a list with at least one anchor");
    for (size_t i = 0; i < json.size(); ++i) {
        if (!readAnchor(reader, json[i], pointer + "/" + std::to_string(i), anchors.emplace_back()))
            return false;
    }
    return true;
}

}  // namespace sherd
