// SPDX-License-Identifier: MIT
// The keys that choose pieces, as all levels that divide chosen ones have them.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sherd/baker/volume_cut.h"

namespace sherd {

inline constexpr std::array<std::string_view, 5> kChoiceKeys = {"larger", "smaller", "near",
                                                                "within", "name"};

/// key: one of `kChoiceKeys`. Returns what is wrong with the value; nothing if it was read.
std::optional<std::string> readChoice(std::string_view key, std::string_view value,
                                      PieceChoice& choice);

/// What is wrong with KEY=VALUE unless it is a number from low to high, which it then reads.
std::optional<std::string> readShare(std::string_view key, std::string_view value, double low,
                                     double high, double& number);

/// What is wrong with `value` unless it is X,Y,Z[;X,Y,Z]..., which are then added; key: "near=".
std::optional<std::string> readPlaces(std::string_view key, std::string_view value,
                                      std::vector<glm::dvec3>& places);

}  // namespace sherd
