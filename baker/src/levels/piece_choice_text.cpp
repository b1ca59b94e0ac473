// SPDX-License-Identifier: MIT
#include "levels/piece_choice_text.h"

#include <sstream>

#include "text_fields.h"

namespace sherd {

std::optional<std::string> readShare(std::string_view key, std::string_view value, double low,
                                     double high, double& number) {
    if (readNumber(value, number) && number >= low && number <= high) return {};
    std::ostringstream what;
    what << key << '=' << value << " is not a number from " << low << " to " << high;
    return what.str();
}

std::optional<std::string> readPlaces(std::string_view key, std::string_view value,
                                      std::vector<glm::dvec3>& places) {
    constexpr size_t kMostPlaces = 10'000;
    for (const std::string_view place : split(value, ';')) {
        glm::dvec3 point;
        if (!readVector(place, point)) {
            return sherd::quoted(std::string(key).append(value))
                .append(" is not ")
                .append(key)
                .append("X,Y,Z[;X,Y,Z]...");
        }
        places.push_back(point);
    }
    if (places.size() <= kMostPlaces) return {};
    return "there can be " + std::to_string(kMostPlaces) + " points at most";
}

std::optional<std::string> readChoice(std::string_view key, std::string_view value,
                                      PieceChoice& choice) {
    if (key == "larger") return readShare(key, value, 0, 1, choice.larger);
    if (key == "smaller") return readShare(key, value, 0, 1, choice.smaller);
    if (key == "within") return readShare(key, value, 0, 1e9, choice.within);
    if (key == "near") return readPlaces("near=", value, choice.near);
    choice.name = value;
    if (!value.empty()) return {};
    return "name= is the name of a piece, as a label says it";
}

}  // namespace sherd
