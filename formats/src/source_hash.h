// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <vector>

#include "sherd/formats/fracture_set.h"

namespace sherd {

/// Hash of the shape of an object's glTF meshes as stored: positions and indices of all primitives,
/// mesh after mesh, so that a fracture set baked from an older shape is noticed. 16 hexadecimal
/// digits.
std::string sourceHash(const nlohmann::json& document, std::span<const uint8_t> bin,
                       std::span<const size_t> meshes);

/// The meshes of an object: that of its set, then those that its joined nodes show. A node that
/// shows none counts as a mesh that does not exist.
std::vector<size_t> meshesOf(const nlohmann::json& document, const FractureSet& set);

}  // namespace sherd
