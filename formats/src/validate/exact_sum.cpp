// SPDX-License-Identifier: MIT
#include "exact_sum.h"

#include <bit>
#include <cstddef>

namespace sherd {

namespace {

/// |x| = mantissa * 2^exponent, exponent at least -149.
struct Parts {
    uint32_t mantissa;
    int exponent;
    bool negative;
};

Parts partsOf(float x) {
    const auto bits = std::bit_cast<uint32_t>(x);
    const auto raw = static_cast<int>(bits >> 23 & 0xFF);
    const uint32_t fraction = bits & 0x7FFFFF;
    if (raw == 0) return {fraction, -149, bits >> 31 != 0};
    return {fraction | 0x800000, raw - 150, bits >> 31 != 0};
}

}  // namespace

void ExactSum::add(int sign, float a, float b, float c) {
    const Parts p = partsOf(a), q = partsOf(b), r = partsOf(c);
    const bool negative = (sign < 0) != ((p.negative != q.negative) != r.negative);
    const int bit = p.exponent + q.exponent + r.exponent - kLowest;
    const uint64_t product = uint64_t{p.mantissa} * q.mantissa;  // below 2^48
    addAt(bit, (product & 0xFFFFFF) * r.mantissa, negative);
    addAt(bit + 24, (product >> 24) * r.mantissa, negative);
}

void ExactSum::addAt(int bit, uint64_t value, bool negative) {
    const int shift = bit % 32;
    // At most 48 bits, shifted by at most 31: three words.
    const std::array<uint32_t, 3> part = {
        static_cast<uint32_t>(value << shift), static_cast<uint32_t>(value << shift >> 32),
        shift == 0 ? 0 : static_cast<uint32_t>(value >> (64 - shift))};
    int64_t carry = 0;
    const size_t first = static_cast<size_t>(bit) / 32;
    for (size_t k = 0; first + k < words_.size() && (k < part.size() || carry != 0); ++k) {
        uint32_t& word = words_[first + k];
        const int64_t own = k < part.size() ? int64_t{part[k]} : 0;
        const int64_t sum = int64_t{word} + (negative ? -own : own) + carry;
        word = static_cast<uint32_t>(sum & 0xFFFFFFFF);
        carry = sum >> 32;
    }
}

int ExactSum::sign() const {
    if (words_.back() >> 31 != 0) return -1;
    for (const uint32_t word : words_)
        if (word != 0) return 1;
    return 0;
}

}  // namespace sherd
