// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>

namespace sherd::cli {

/// `sherd-bake recipe`: commented examples, and the schema that editors check recipes by.
void addRecipeCommand(CLI::App& app, int& exitCode);

}  // namespace sherd::cli
