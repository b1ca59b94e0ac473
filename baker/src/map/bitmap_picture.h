// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "sherd/formats/result.h"

namespace sherd {

inline constexpr int kMaxBitmapSide = 16384;
inline constexpr int64_t kMaxBitmapTexels = int64_t{64} << 20;

/// A decoded picture, row by row from the top, 8 bits a channel.
struct Picture {
    int width = 0, height = 0;
    std::vector<uint8_t> grey;   ///< luminance
    std::vector<uint8_t> alpha;  ///< empty: opaque throughout

    size_t size() const { return grey.size(); }
};

/// Decodes a PNG or JPEG; its declared size is checked before any pixel is.
Result<Picture> decodePicture(std::span<const uint8_t> bytes, const std::string& name);

}  // namespace sherd
