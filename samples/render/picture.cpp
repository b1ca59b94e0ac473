// SPDX-License-Identifier: MIT
#include "picture.h"

#include <stb/stb_image_write.h>

#include <algorithm>

#include "sherd/formats/glb_write.h"

namespace sherd::samples {
namespace {

constexpr uint32_t kGap = 4;

void paste(const Picture& from, uint32_t x, uint32_t y, Picture& to) {
    const size_t row = size_t{3} * from.width;
    for (uint32_t line = 0; line < from.height; ++line) {
        std::copy_n(&from.pixels[row * line], row,
                    &to.pixels[(size_t{y + line} * to.width + x) * 3]);
    }
}

void append(void* context, void* data, int count) {
    auto& bytes = *static_cast<std::vector<uint8_t>*>(context);
    const auto* begin = static_cast<const uint8_t*>(data);
    bytes.insert(bytes.end(), begin, begin + count);
}

}  // namespace

Picture shrink(const Picture& picture, uint32_t width) {
    const uint32_t height = std::max(1U, picture.height * width / picture.width);
    Picture out{width, height, std::vector<uint8_t>(size_t{3} * width * height)};
    for (uint32_t y = 0; y < height; ++y) {
        const uint32_t y0 = y * picture.height / height;
        const uint32_t y1 = std::max(y0 + 1, (y + 1) * picture.height / height);
        for (uint32_t x = 0; x < width; ++x) {
            const uint32_t x0 = x * picture.width / width;
            const uint32_t x1 = std::max(x0 + 1, (x + 1) * picture.width / width);
            for (uint32_t c = 0; c < 3; ++c) {
                uint32_t sum = 0;
                for (uint32_t v = y0; v < y1; ++v) {
                    for (uint32_t u = x0; u < x1; ++u)
                        sum += picture.pixels[(size_t{v} * picture.width + u) * 3 + c];
                }
                out.pixels[(size_t{y} * width + x) * 3 + c] =
                    static_cast<uint8_t>(sum / ((x1 - x0) * (y1 - y0)));
            }
        }
    }
    return out;
}

Picture contactSheet(std::span<const Picture> pictures, uint32_t columns) {
    Picture sheet;
    if (pictures.empty()) return sheet;
    const auto rows = static_cast<uint32_t>((pictures.size() + columns - 1) / columns);
    const uint32_t stepX = pictures[0].width + kGap;
    const uint32_t stepY = pictures[0].height + kGap;
    sheet.width = stepX * columns + kGap;
    sheet.height = stepY * rows + kGap;
    sheet.pixels.assign(size_t{3} * sheet.width * sheet.height, 24);
    for (uint32_t i = 0; i < pictures.size(); ++i) {
        paste(pictures[i], kGap + i % columns * stepX, kGap + i / columns * stepY, sheet);
    }
    return sheet;
}

Result<void> writePng(const std::filesystem::path& path, const Picture& picture) {
    std::vector<uint8_t> png;
    const auto width = static_cast<int>(picture.width);
    stbi_write_png_to_func(append, &png, width, static_cast<int>(picture.height), 3,
                           picture.pixels.data(), 3 * width);
    return writeFileWhole(path, png);
}

Result<void> writeJpeg(const std::filesystem::path& path, const Picture& picture, int quality) {
    std::vector<uint8_t> jpeg;
    stbi_write_jpg_to_func(append, &jpeg, static_cast<int>(picture.width),
                           static_cast<int>(picture.height), 3, picture.pixels.data(), quality);
    return writeFileWhole(path, jpeg);
}

}  // namespace sherd::samples
