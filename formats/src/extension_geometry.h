// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "extension_reader.h"

namespace sherd {

/// The geometry of all fragments, plain or as a Draco stream; `parent`: the fracture's JSON
/// pointer.
void readGeometry(ExtensionReader& in, const nlohmann::json& fracture, const std::string& parent,
                  FractureSet& set);

}  // namespace sherd
