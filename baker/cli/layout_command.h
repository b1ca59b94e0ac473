// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>

namespace sherd::cli {

/// `sherd-bake layout`: sets `exitCode` when it has run.
void addLayoutCommand(CLI::App& app, int& exitCode);

}  // namespace sherd::cli
