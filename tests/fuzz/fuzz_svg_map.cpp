// SPDX-License-Identifier: MIT
#include <string_view>

#include "fuzzed_map.h"

namespace {

/// Uses within uses double the work until a limit ends it; the limit has a test of its own, and
/// takes longer than a fuzzer should spend on one input.
bool usesTooOften(std::string_view text) {
    constexpr int kMostUses = 12;
    int uses = 0;
    for (size_t at = text.find("use"); at != std::string_view::npos; at = text.find("use", at + 1))
        ++uses;
    return uses > kMostUses;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    if (usesTooOften(text)) return 0;
    sherd::MapReadOptions options;
    options.tolerance = 1e-2;
    options.levelOfColor = {{"red", 2}, {"#0000ff", 3}};
    sherd::fuzz::use(sherd::readSvgMap(text, "fuzz.svg", options));
    return 0;
}
