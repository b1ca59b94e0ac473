// SPDX-License-Identifier: MIT
#include "fuzzed_model.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    sherd::fuzz::importFile(data, size, ".obj");
    return 0;
}
