// SPDX-License-Identifier: MIT
#include "sherd/runtime/hooks.h"

#include <cstdio>
#include <cstdlib>

#include "core/report.h"

namespace sherd {
namespace {

Hooks current;

}  // namespace

void setHooks(const Hooks& hooks) {
    current = hooks;
}

const Hooks& hooks() {
    return current;
}

bool assertFailed(const char* condition, const char* file, int line) {
    if (current.assertFailed && current.assertFailed(current.user, condition, file, line))
        return false;
    if (!current.assertFailed)
        std::fprintf(stderr, "sherd: %s does not hold (%s:%d)\n", condition, file, line);
    std::abort();
}

}  // namespace sherd
