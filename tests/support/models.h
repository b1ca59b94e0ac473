// SPDX-License-Identifier: MIT
// Real models and maps live beside the checkout, in ../shared; the project ships none of them.
#pragma once

#include <cstdlib>
#include <filesystem>

namespace sherd::test {

/// The folder of real models and maps ($SHERD_SHARED, else ../shared beside the sources).
inline std::filesystem::path sharedDir() {
    if (const char* dir = std::getenv("SHERD_SHARED")) return dir;
    return std::filesystem::path(SHERD_SOURCE_DIR) / ".." / "shared";
}

/// Whether real models are there at all. When they are, no case that uses them may be skipped.
inline bool haveSharedModels() {
    return std::filesystem::is_directory(sharedDir() / "models");
}

}  // namespace sherd::test
