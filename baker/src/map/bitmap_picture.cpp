// SPDX-License-Identifier: MIT
#include "map/bitmap_picture.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <memory>

#include "map/jpeg_check.h"

namespace sherd::stb {

// What the largest permitted picture needs at 16 bits and four channels, filter bytes included. A
// PNG whose data inflate to more than that lies about its size.
constexpr size_t kMaxBlock = static_cast<size_t>(kMaxBitmapTexels) * 8 + (size_t{1} << 20);

// Zeroed: damaged files make stb_image read what it never wrote, and must give the same every time.
static void* allocate(size_t size) {
    return size > kMaxBlock ? nullptr : std::calloc(size, 1);
}
static void* reallocate(void* block, size_t before, size_t size) {
    void* larger = size > kMaxBlock ? nullptr : std::realloc(block, size);
    if (larger != nullptr && size > before)
        std::memset(static_cast<char*>(larger) + before, 0, size - before);
    return larger;
}

}  // namespace sherd::stb

#define STBI_MALLOC(size) sherd::stb::allocate(size)
#define STBI_REALLOC_SIZED(block, before, size) \
    sherd::stb::reallocate(block, (block) == nullptr ? 0 : (before), size)
#define STBI_FREE(block) std::free(block)
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_NO_STDIO
#define STBI_MAX_DIMENSIONS 16384
// Private to this file: a game or a test may hold its own copy.
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#ifdef __clang__
// An empty first data chunk, which PNG permits, makes it copy no bytes to a null pointer: harmless,
// but the sanitizer minds.
#pragma clang attribute push(__attribute__((no_sanitize("nonnull-attribute"))), apply_to = function)
#endif
#include <stb/stb_image.h>
#ifdef __clang__
#pragma clang attribute pop
#endif
#pragma GCC diagnostic pop

namespace sherd {

static_assert(STBI_MAX_DIMENSIONS == kMaxBitmapSide);

namespace {

constexpr std::array<uint8_t, 8> kPngStart{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
constexpr std::array<uint8_t, 3> kJpegStart{0xff, 0xd8, 0xff};

template <size_t n>
bool startsWith(std::span<const uint8_t> bytes, const std::array<uint8_t, n>& start) {
    return bytes.size() >= n && std::equal(start.begin(), start.end(), bytes.begin());
}

uint32_t bigEndian(std::span<const uint8_t> bytes, size_t at) {
    return uint32_t{bytes[at]} << 24 | uint32_t{bytes[at + 1]} << 16 |
           uint32_t{bytes[at + 2]} << 8 | bytes[at + 3];
}

Error tooLarge(int64_t width, int64_t height, const std::string& name) {
    return {ErrorCode::limitExceeded,
            "the picture is " + std::to_string(width) + " x " + std::to_string(height) +
                " texels; at most " + std::to_string(kMaxBitmapSide) + " a side and " +
                std::to_string(kMaxBitmapTexels >> 20) + " Mi in all are read: scale it down",
            name};
}

Error broken(const std::string& name) {
    const char* reason = stbi_failure_reason();
    return {ErrorCode::malformed,
            std::string("the picture cannot be decoded (") +
                (reason == nullptr ? "no reason given" : reason) + "); save it again",
            name};
}

/// The size in a PNG's header, which has a fixed place: stb_image refuses sizes beyond its own
/// limit without saying what they were.
Result<void> checkPngSize(std::span<const uint8_t> bytes, const std::string& name) {
    if (bytes.size() < 24)
        return fail(ErrorCode::malformed, "the PNG ends within its header", name);
    const uint32_t width = bigEndian(bytes, 16);
    const uint32_t height = bigEndian(bytes, 20);
    if (width > kMaxBitmapSide || height > kMaxBitmapSide)
        return tl::unexpected(tooLarge(width, height, name));
    return {};
}

Result<void> checkHeader(std::span<const uint8_t> bytes, const std::string& name) {
    const bool png = startsWith(bytes, kPngStart);
    const bool jpeg = startsWith(bytes, kJpegStart);
    if (!png && !jpeg)
        return fail(ErrorCode::malformed, "neither a PNG nor a JPEG: the file's start is neither's",
                    name);
    if (png) {
        if (const Result<void> size = checkPngSize(bytes, name); !size)
            return tl::unexpected(size.error());
    } else if (!jpegIsWhole(bytes)) {
        return fail(ErrorCode::malformed, "the JPEG is cut off: it has no end; save it again",
                    name);
    } else if (!jpegTablesFit(bytes)) {
        return fail(ErrorCode::malformed, "the JPEG's Huffman tables are damaged; save it again",
                    name);
    }
    int width = 0;
    int height = 0;
    int channels = 0;
    if (stbi_info_from_memory(bytes.data(), static_cast<int>(bytes.size()), &width, &height,
                              &channels) == 0)
        return tl::unexpected(broken(name));
    if (width > kMaxBitmapSide || height > kMaxBitmapSide ||
        int64_t{width} * height > kMaxBitmapTexels)
        return tl::unexpected(tooLarge(width, height, name));
    return {};
}

}  // namespace

Result<Picture> decodePicture(std::span<const uint8_t> bytes, const std::string& name) {
    if (const Result<void> fine = checkHeader(bytes, name); !fine)
        return tl::unexpected(fine.error());
    Picture picture;
    int channels = 0;
    const std::unique_ptr<stbi_uc, void (*)(void*)> texels(
        stbi_load_from_memory(bytes.data(), static_cast<int>(bytes.size()), &picture.width,
                              &picture.height, &channels, 2),
        stbi_image_free);
    if (texels == nullptr) return tl::unexpected(broken(name));
    const size_t count = static_cast<size_t>(picture.width) * picture.height;
    const std::span<const stbi_uc> pairs(texels.get(), 2 * count);
    picture.grey.resize(count);
    for (size_t i = 0; i < count; ++i) picture.grey[i] = pairs[2 * i];
    bool opaque = true;
    for (size_t i = 0; i < count && opaque; ++i) opaque = pairs[2 * i + 1] == 255;
    if (opaque) return picture;
    picture.alpha.resize(count);
    for (size_t i = 0; i < count; ++i) picture.alpha[i] = pairs[2 * i + 1];
    return picture;
}

}  // namespace sherd
