// SPDX-License-Identifier: MIT
#pragma once

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "sherd/baker/fracture_plan.h"

namespace sherd::test {

inline Pattern pattern(const std::string& text) {
    const Result<Pattern> parsed = parsePattern(text);
    if (!parsed) FAIL(parsed.error().message);
    return *parsed;
}

/// A pattern per level, from level 1 on.
inline FracturePlan patterns(const std::vector<std::string>& texts) {
    FracturePlan plan;
    for (const std::string& text : texts)
        plan.patterns.push_back({pattern(text), static_cast<uint32_t>(plan.patterns.size() + 1)});
    return plan;
}

}  // namespace sherd::test
