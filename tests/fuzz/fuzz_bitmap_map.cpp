// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "fuzzed_map.h"

namespace {

/// What the header of a PNG or JPEG declares. Small files may declare pictures that take seconds
/// under instrumentation; those have tests of their own.
uint64_t declaredTexels(const uint8_t* data, size_t size) {
    const auto number = [data](size_t at, size_t bytes) {
        uint64_t value = 0;
        for (size_t i = 0; i < bytes; ++i) value = value << 8 | data[at + i];
        return value;
    };
    if (size >= 24 && number(0, 4) == 0x89504E47) return number(16, 4) * number(20, 4);
    uint64_t most = 0;
    for (size_t i = 0; i + 9 <= size; ++i) {  // frame headers of a JPEG, wherever they stand
        if (data[i] == 0xFF && data[i + 1] >= 0xC0 && data[i + 1] <= 0xC2)
            most = std::max(most, number(i + 5, 2) * number(i + 7, 2));
    }
    return most;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    constexpr uint64_t kMostTexels = 1 << 18;
    if (declaredTexels(data, size) > kMostTexels) return 0;
    sherd::fuzz::use(sherd::readBitmapMap({data, size}, "fuzz.png", {}));
    return 0;
}
