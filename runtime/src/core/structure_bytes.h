// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "core/byte_stream.h"
#include "sherd/runtime/structure.h"

namespace sherd {

/// What a structure has lost, in as many bytes as it has damage. The bake's hash goes first.
void writeStructure(const Structure& structure, ByteWriter& to);

/// Of an object of this asset; what is wrong with the bytes, or nullptr.
const char* readStructure(const std::shared_ptr<const Asset>& asset, ByteReader& from,
                          std::optional<Structure>& structure);

}  // namespace sherd
