// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace sherd {

enum class LogLevel { note, warning, error };

/// Where Sherd's messages go and what it does when the program made a mistake. One set for the
/// process; functions may be called from every thread that calls Sherd, and must not throw.
struct Hooks {
    void* user = nullptr;  ///< handed back to the functions
    /// Null: nowhere. `message` is valid during the call.
    void (*log)(void* user, LogLevel level, const char* message) = nullptr;
    /// A condition of the program's own making does not hold. True: go on as if nothing was asked;
    /// false: abort. Null: print and abort.
    bool (*assertFailed)(void* user, const char* condition, const char* file, int line) = nullptr;
};

/// Set it before other threads use Sherd.
void setHooks(const Hooks& hooks);
const Hooks& hooks();

/// The game's job system, for work that is worth several threads.
struct Jobs {
    void* user = nullptr;
    /// Calls `job(data, i)` once for every i < count, on any threads in any order, and returns when
    /// all have returned. Null: Sherd calls them one by one.
    void (*run)(void* user, uint32_t count, void (*job)(void* data, uint32_t index),
                void* data) = nullptr;
};

}  // namespace sherd
