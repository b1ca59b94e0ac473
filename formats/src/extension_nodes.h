// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "extension_reader.h"

namespace sherd {

/// Which nodes carry each of the document's fractures.
void readNodes(ExtensionReader& in, const nlohmann::json& document, std::vector<FractureSet>& sets);

}  // namespace sherd
