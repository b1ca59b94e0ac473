// SPDX-License-Identifier: MIT
#pragma once

#include "sherd/runtime/hooks.h"

namespace sherd {

/// Into the game's log, if it has one.
inline void log(LogLevel level, const char* message) {
    if (hooks().log) hooks().log(hooks().user, level, message);
}

/// Asks the game's handler; returns false, or does not return.
bool assertFailed(const char* condition, const char* file, int line);

}  // namespace sherd

/// Whether a condition of the caller's making holds: `if (!SHERD_ASSERT(x)) return;`.
#define SHERD_ASSERT(condition) \
    ((condition) ? true : ::sherd::assertFailed(#condition, __FILE__, __LINE__))
