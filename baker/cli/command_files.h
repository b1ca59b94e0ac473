// SPDX-License-Identifier: MIT
#pragma once

#include <unistd.h>

#include <cctype>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
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

/// Whether a file could take this place, as far as that shows without trying.
inline Result<void> checkWritable(const std::filesystem::path& path) {
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored))
        return fail(ErrorCode::fileWrite, "this is a directory; name a file in it", path.string());
    const std::filesystem::path folder =
        path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
    if (!std::filesystem::exists(folder, ignored))
        return fail(ErrorCode::fileWrite,
                    "cannot write the file: its directory does not exist; create it first",
                    path.string());
    if (!std::filesystem::is_directory(folder, ignored))
        return fail(ErrorCode::fileWrite,
                    "cannot write the file: " + folder.string() + " is not a directory",
                    path.string());
    if (::access(folder.c_str(), W_OK) != 0 && ::access(path.c_str(), W_OK) != 0)
        return fail(ErrorCode::fileWrite,
                    "cannot write the file: no permission; choose another place", path.string());
    return {};
}

/// Whether an output's name ends so, in small letters or capitals. Devices may have any name.
inline bool hasKind(const std::filesystem::path& path, const std::string& ending) {
    std::error_code ignored;
    if (std::filesystem::exists(path, ignored) && !std::filesystem::is_regular_file(path, ignored))
        return true;
    std::string kind = path.extension().string();
    for (char& c : kind) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return kind == ending;
}

inline bool isSameFile(const std::filesystem::path& a, const std::filesystem::path& b) {
    std::error_code ignored;
    return std::filesystem::weakly_canonical(a, ignored) ==
           std::filesystem::weakly_canonical(b, ignored);
}

/// Says on stderr what went wrong, and returns its exit code.
inline int printError(const Error& error) {
    std::fprintf(stderr, "sherd-bake: %s%s%s\n", error.where.c_str(),
                 error.where.empty() ? "" : ": ", error.message.c_str());
    return exitCodeOf(error.code);
}

}  // namespace sherd::cli
