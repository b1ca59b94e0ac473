// SPDX-License-Identifier: MIT
// What a fracture map may hold, whatever its format.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "sherd/baker/fracture_map.h"

namespace sherd {

inline constexpr size_t kMaxMapBytes = size_t{64} << 20;
inline constexpr size_t kMaxMapPoints = 4'000'000;  ///< after flattening
inline constexpr size_t kMaxMapLabels = 100'000;
inline constexpr uint32_t kMaxMapLevel = 64;

/// The bytes of a file, at most kMaxMapBytes. what: for messages, "fracture map".
Result<std::string> readMapFile(const std::filesystem::path& path, const std::string& what);

/// The text's size and the options' ranges.
Result<void> checkMapInput(std::string_view text, const std::string& name,
                           const MapReadOptions& options);

}  // namespace sherd
