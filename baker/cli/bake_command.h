// SPDX-License-Identifier: MIT
#pragma once

namespace CLI {
class App;
}

namespace sherd::cli {

/// `sherd-bake bake`: sets `exitCode` when it has run.
void addBakeCommand(CLI::App& app, int& exitCode);

}  // namespace sherd::cli
