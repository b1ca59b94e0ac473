// SPDX-License-Identifier: MIT
// A PNG of any bit depth and colour type, uncompressed: what it holds is what the test says, also
// where no honest encoder would write it.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string_view>
#include <vector>

namespace sherd::test {

struct PngImage {
    uint32_t width = 0, height = 0;
    uint8_t bitDepth = 8;
    uint8_t colorType = 0;         ///< 0 grey, 2 RGB, 3 palette, 4 grey and alpha, 6 RGBA
    std::vector<uint8_t> rows;     ///< packed as the format says, without filter bytes
    std::vector<uint8_t> palette;  ///< RGB triples
};

namespace png {

inline void put32(std::vector<uint8_t>& out, uint32_t value) {
    for (int shift = 24; shift >= 0; shift -= 8)
        out.push_back(static_cast<uint8_t>(value >> shift));
}

inline uint32_t crc(const uint8_t* bytes, size_t size) {
    uint32_t c = 0xffffffff;
    for (size_t i = 0; i < size; ++i) {
        c ^= bytes[i];
        for (int k = 0; k < 8; ++k) c = (c & 1) != 0 ? 0xedb88320 ^ (c >> 1) : c >> 1;
    }
    return ~c;
}

inline void chunk(std::vector<uint8_t>& out, std::string_view type,
                  const std::vector<uint8_t>& data) {
    put32(out, static_cast<uint32_t>(data.size()));
    const size_t start = out.size();
    out.insert(out.end(), type.begin(), type.end());
    out.insert(out.end(), data.begin(), data.end());
    put32(out, crc(out.data() + start, out.size() - start));
}

/// zlib with stored blocks only.
inline std::vector<uint8_t> deflateStored(const std::vector<uint8_t>& data) {
    std::vector<uint8_t> out{0x78, 0x01};
    uint32_t a = 1;
    uint32_t b = 0;
    for (const uint8_t byte : data) {
        a = (a + byte) % 65521;
        b = (b + a) % 65521;
    }
    for (size_t at = 0; at < data.size(); at += 65535) {
        const auto size = static_cast<uint32_t>(std::min<size_t>(65535, data.size() - at));
        out.push_back(at + size == data.size() ? 1 : 0);
        for (const uint32_t v : {size, ~size}) {
            out.push_back(static_cast<uint8_t>(v));
            out.push_back(static_cast<uint8_t>(v >> 8));
        }
        out.insert(out.end(), data.begin() + static_cast<ptrdiff_t>(at),
                   data.begin() + static_cast<ptrdiff_t>(at + size));
    }
    put32(out, b << 16 | a);
    return out;
}

}  // namespace png

inline std::vector<uint8_t> pngBytes(const PngImage& image) {
    std::vector<uint8_t> out{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    std::vector<uint8_t> header;
    png::put32(header, image.width);
    png::put32(header, image.height);
    header.insert(header.end(), {image.bitDepth, image.colorType, 0, 0, 0});
    png::chunk(out, "IHDR", header);
    if (!image.palette.empty()) png::chunk(out, "PLTE", image.palette);
    std::vector<uint8_t> filtered;
    const size_t row = image.height == 0 ? 0 : image.rows.size() / image.height;
    for (size_t at = 0; row > 0 && at < image.rows.size(); at += row) {
        filtered.push_back(0);
        filtered.insert(filtered.end(), image.rows.begin() + static_cast<ptrdiff_t>(at),
                        image.rows.begin() + static_cast<ptrdiff_t>(at + row));
    }
    png::chunk(out, "IDAT", png::deflateStored(filtered));
    png::chunk(out, "IEND", {});
    return out;
}

}  // namespace sherd::test
