// SPDX-License-Identifier: MIT
#pragma once

#include <array>

namespace sherd::cli {

struct RecipeExample {
    const char* name;
    const char* about;
    const char* text;
};
extern const std::array<RecipeExample, 9> kRecipeExamples;

/// JSON Schema, draft 7.
extern const char* const kRecipeSchema;

}  // namespace sherd::cli
