// SPDX-License-Identifier: MIT
#include "fuzzed_map.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    sherd::fuzz::use(sherd::readBitmapMap({data, size}, "fuzz.png", {}));
    return 0;
}
