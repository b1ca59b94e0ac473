// SPDX-License-Identifier: MIT
#include <string_view>

#include "fuzzed_map.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    sherd::MapReadOptions options;
    options.tolerance = 1e-2;
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    sherd::fuzz::use(sherd::readJsonMap(text, "fuzz.json", options));
    return 0;
}
