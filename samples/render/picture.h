// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "sherd/formats/result.h"

namespace sherd::samples {

/// 8-bit RGB, rows from the top.
struct Picture {
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<uint8_t> pixels;
};

/// The picture at `width` pixels, each the mean of what it covers.
Picture shrink(const Picture& picture, uint32_t width);

/// Pictures of one size in rows of `columns`, with a thin margin.
Picture contactSheet(std::span<const Picture> pictures, uint32_t columns);

Result<void> writePng(const std::filesystem::path& path, const Picture& picture);

/// `quality` from 1 to 100.
Result<void> writeJpeg(const std::filesystem::path& path, const Picture& picture, int quality);

}  // namespace sherd::samples
