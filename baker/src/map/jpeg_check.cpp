// SPDX-License-Identifier: MIT
// What stb_image leaves unchecked in a JPEG (ITU-T T.81, annex B): markers are 0xff and a byte that
// says what follows, most often a segment that starts with its own length.
#include "map/jpeg_check.h"

#include <cstddef>

namespace sherd {

namespace {

constexpr uint8_t kHuffmanTables = 0xc4;
constexpr uint8_t kEnd = 0xd9;
constexpr uint8_t kScan = 0xda;
constexpr int kMostCodes = 256;

class Reader {
  public:
    Reader(std::span<const uint8_t> bytes, size_t at) : bytes_(bytes), at_(at) {}
    bool atEnd() const { return at_ >= bytes_.size(); }
    size_t position() const { return at_; }
    void skip(size_t count) { at_ += count; }
    /// 0 beyond the end, as stb_image reads.
    uint8_t byte() { return atEnd() ? 0 : bytes_[at_++]; }
    int length() {
        const int high = byte();
        return high << 8 | byte();
    }
    /// The next marker; 0 if there is none.
    uint8_t marker() {
        while (!atEnd() && bytes_[at_] != 0xff) ++at_;
        while (!atEnd() && bytes_[at_] == 0xff) ++at_;
        return byte();
    }

  private:
    std::span<const uint8_t> bytes_;
    size_t at_;
};

/// Of a segment of Huffman tables; `reader` is at its length.
bool tablesFit(Reader reader) {
    int left = reader.length() - 2;
    while (left > 0) {
        const uint8_t kind = reader.byte();
        if (kind >> 4 > 1 || (kind & 15) > 3) return true;  // stb_image stops here with an error
        int codes = 0;
        for (int i = 0; i < 16; ++i) codes += reader.byte();
        if (codes > kMostCodes) return false;
        reader.skip(static_cast<size_t>(codes));
        left -= 17 + codes;
    }
    return true;
}

}  // namespace

bool jpegIsWhole(std::span<const uint8_t> bytes) {
    // In compressed data 0xff stands before 0x00 or a marker only: the end comes after the last
    // scan.
    for (size_t i = bytes.size(); i-- > 1;) {
        if (bytes[i - 1] != 0xff) continue;
        if (bytes[i] == kEnd) return true;
        if (bytes[i] == kScan) return false;
    }
    return false;
}

bool jpegTablesFit(std::span<const uint8_t> bytes) {
    Reader reader(bytes, 2);
    // Up to the first scan segments follow each other; what other segments hold is no marker.
    for (uint8_t marker = reader.marker(); marker != kScan && !reader.atEnd();
         marker = reader.marker()) {
        if (marker == kHuffmanTables && !tablesFit(reader)) return false;
        Reader segment = reader;
        const int length = segment.length();
        reader.skip(length < 2 ? 0 : static_cast<size_t>(length));
    }
    // Damaged data may let a decoder take any marker after that.
    for (size_t i = reader.position(); i + 1 < bytes.size(); ++i)
        if (bytes[i] == 0xff && bytes[i + 1] == kHuffmanTables && !tablesFit({bytes, i + 2}))
            return false;
    return true;
}

}  // namespace sherd
