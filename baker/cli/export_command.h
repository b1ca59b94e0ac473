// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

namespace CLI {
class App;
}

namespace sherd::cli {

struct ExportArguments {
    std::filesystem::path input;
    std::filesystem::path directory;  ///< created when missing
    bool medial = false;              ///< the medial surface alone, as `medial.obj`
};

/// Writes every fragment of every level as `level<k>_fragment<i>.obj`, all files or none.
/// Returns an exit code.
int runExport(const ExportArguments& arguments);

/// Registers `export`. `exitCode` receives the result when the subcommand was called; it must
/// outlive the parsing.
void addExportCommand(CLI::App& app, int& exitCode);

}  // namespace sherd::cli
