// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

namespace CLI {
class App;
}

namespace sherd::cli {

struct CheckArguments {
    std::filesystem::path input;
    bool json = false;      ///< the report as JSON on stdout instead of a table
    bool coverage = false;  ///< also measure how completely each level fills the object
    bool measure = false;   ///< that, and self-intersections and the thinnest part
};

/// Re-verifies a baked file from the file alone. Returns an exit code.
int runCheck(const CheckArguments& arguments);

/// Registers `check`. `exitCode` receives the result when the subcommand was called; it must
/// outlive the parsing.
void addCheckCommand(CLI::App& app, int& exitCode);

}  // namespace sherd::cli
