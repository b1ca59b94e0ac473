// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace sherd::test {

/// How often `operator new` was called so far. Link allocation_count.cpp, which replaces it.
uint64_t allocationCount();

}  // namespace sherd::test
