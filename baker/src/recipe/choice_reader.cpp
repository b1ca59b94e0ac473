// SPDX-License-Identifier: MIT
#include "recipe/choice_reader.h"

#include <algorithm>
#include <cmath>

namespace sherd {
namespace {

bool isPlace(const nlohmann::json& json) {
    return json.is_array() && json.size() == 3 &&
           std::all_of(json.begin(), json.end(), [](const nlohmann::json& x) {
               return x.is_number() && std::abs(x.get<double>()) <= kFarthestPlace;
           });
}

}  // namespace

bool readPlaces(RecipeReader& reader, const nlohmann::json& json, const std::string& pointer,
                std::vector<glm::dvec3>& places) {
    const auto add = [&](const nlohmann::json& j) {
        places.emplace_back(j[0].get<double>(), j[1].get<double>(), j[2].get<double>());
    };
    if (isPlace(json)) {
        add(json);
        return true;
    }
    if (!json.is_array() || json.empty() || !std::all_of(json.begin(), json.end(), isPlace))
        return reader.wrong(pointer,
                            "must be a point [x, y, z] in metres, or a list of such points, with "
                            "numbers from -1e+09 to 1e+09");
    for (const nlohmann::json& place : json) add(place);
    return true;
}

bool readChoice(RecipeReader& reader, const nlohmann::json& json, const std::string& pointer,
                PieceChoice& choice) {
    if (!reader.object(
            json, pointer,
            {{"larger", reader.number(choice.larger, 0, 1)},
             {"smaller", reader.number(choice.smaller, 0, 1)},
             {"near", [&](const nlohmann::json& j,
                          const std::string& p) { return readPlaces(reader, j, p, choice.near); }},
             {"within", reader.number(choice.within, 0, kFarthestPlace)},
             {"name", reader.string(choice.name)}}))
        return false;
    if (choice.within > 0 && choice.near.empty())
        return reader.wrong(pointer + "/within", "needs a place to be \"near\"");
    if (choice.all())
        return reader.wrong(pointer,
                            "chooses nothing: say \"larger\", \"smaller\", \"near\" or "
                            "\"name\", or leave it out");
    return true;
}

}  // namespace sherd
