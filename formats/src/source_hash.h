// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>

namespace sherd {

/// Hash of a glTF mesh's shape as stored: positions and indices of all primitives, so that a
/// fracture set baked from an older shape is noticed. 16 hexadecimal digits.
std::string sourceHash(const nlohmann::json& document, std::span<const uint8_t> bin, size_t mesh);

}  // namespace sherd
