// SPDX-License-Identifier: MIT
// Numbers as bytes, least first, whatever the machine's own order.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

namespace sherd {

class ByteWriter {
  public:
    explicit ByteWriter(std::vector<uint8_t>& bytes) : bytes_(bytes) {}

    void u8(uint8_t x) { bytes_.push_back(x); }
    void u32(uint32_t x) {
        for (int i = 0; i < 32; i += 8) bytes_.push_back(uint8_t(x >> i));
    }
    void u64(uint64_t x) {
        u32(uint32_t(x));
        u32(uint32_t(x >> 32));
    }
    void f32(float x) { u32(std::bit_cast<uint32_t>(x)); }
    void f64(double x) { u64(std::bit_cast<uint64_t>(x)); }

  private:
    std::vector<uint8_t>& bytes_;
};

/// Reads zeros beyond the end, and remembers that it did.
class ByteReader {
  public:
    explicit ByteReader(std::span<const uint8_t> bytes) : bytes_(bytes) {}

    uint8_t u8() {
        if (at_ >= bytes_.size()) {
            isShort_ = true;
            return 0;
        }
        return bytes_[at_++];
    }
    uint32_t u32() {
        uint32_t x = 0;
        for (int i = 0; i < 32; i += 8) x |= uint32_t(u8()) << i;
        return x;
    }
    uint64_t u64() {
        const uint64_t low = u32();
        return low | uint64_t(u32()) << 32;
    }
    float f32() { return std::bit_cast<float>(u32()); }
    double f64() { return std::bit_cast<double>(u64()); }

    /// A count of things that take so many bytes each: 0 when there cannot be as many.
    uint32_t count(size_t bytesEach) {
        const uint32_t n = u32();
        if (n <= (bytes_.size() - at_) / bytesEach) return n;
        isShort_ = true;
        return 0;
    }
    /// As many as `count(1)` said there are.
    std::span<const uint8_t> bytes(uint32_t n) {
        const auto found = bytes_.subspan(at_, n);
        at_ += n;
        return found;
    }
    [[nodiscard]] bool isShort() const { return isShort_; }
    [[nodiscard]] bool isAtEnd() const { return at_ == bytes_.size(); }

  private:
    std::span<const uint8_t> bytes_;
    size_t at_ = 0;
    bool isShort_ = false;
};

}  // namespace sherd
