// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <system_error>
#include <vector>

#include "exit_codes.h"
#include "sherd/formats/result.h"

namespace sherd::cli {

/// The bytes of a file named on the command line.
inline Result<std::vector<uint8_t>> readBytes(const std::filesystem::path& path) {
    std::error_code ignored;
    if (!std::filesystem::exists(path, ignored))
        return fail(ErrorCode::fileNotFound, "the file does not exist", path.string());
    if (std::filesystem::is_directory(path, ignored))
        return fail(ErrorCode::fileRead, "this is a directory, not a file", path.string());
    std::ifstream in(path, std::ios::binary);
    std::vector<uint8_t> bytes((std::istreambuf_iterator<char>(in)),
                               std::istreambuf_iterator<char>());
    if (!in) return fail(ErrorCode::fileRead, "the file cannot be read", path.string());
    return bytes;
}

/// Says on stderr what went wrong, and returns its exit code.
inline int printError(const Error& error) {
    std::fprintf(stderr, "sherd-bake: %s%s%s\n", error.where.c_str(),
                 error.where.empty() ? "" : ": ", error.message.c_str());
    return exitCodeOf(error.code);
}

}  // namespace sherd::cli
