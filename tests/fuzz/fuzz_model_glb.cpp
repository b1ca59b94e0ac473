// SPDX-License-Identifier: MIT
#include "fuzzed_model.h"
#include "glb_mutation.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    sherd::fuzz::importFile(data, size, ".glb");
    return 0;
}
