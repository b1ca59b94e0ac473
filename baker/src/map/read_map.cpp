// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cctype>
#include <fstream>
#include <iterator>
#include <system_error>

#include "map/map_limits.h"
#include "map/svg_color.h"

namespace sherd {

namespace {

constexpr const char* kMap = "fracture map";

Error tooLarge(const std::string& name, const std::string& what) {
    return {ErrorCode::limitExceeded,
            "the " + what + " is larger than " + std::to_string(kMaxMapBytes >> 20) +
                " MiB; pictures embedded in a drawing belong beside it",
            name};
}

std::string lowerExtension(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension;
}

}  // namespace

Result<std::string> readMapFile(const std::filesystem::path& path, const std::string& what) {
    std::error_code error;
    if (!std::filesystem::exists(path, error))
        return fail(ErrorCode::fileNotFound, "the " + what + " does not exist", path.string());
    if (std::filesystem::is_directory(path, error))
        return fail(ErrorCode::fileRead, "the " + what + " is a folder", path.string());
    const uintmax_t size = std::filesystem::file_size(path, error);
    if (!error && size > kMaxMapBytes) return tl::unexpected(tooLarge(path.string(), what));
    std::ifstream file(path, std::ios::binary);
    std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
    if (!file.good() && !file.eof())
        return fail(ErrorCode::fileRead, "the " + what + " cannot be read", path.string());
    return text;
}

Result<void> checkMapInput(std::string_view text, const std::string& name,
                           const MapReadOptions& options) {
    if (text.size() > kMaxMapBytes) return tl::unexpected(tooLarge(name, kMap));
    if (options.level < 1 || options.level > kMaxMapLevel)
        return fail(ErrorCode::badArgument,
                    "a map's level must be from 1 to " + std::to_string(kMaxMapLevel), name);
    if (!(options.tolerance >= 1e-8) || !(options.tolerance <= 1))
        return fail(ErrorCode::badArgument,
                    "the flattening tolerance must be from 1e-8 to 1 UV units", name);
    ColorLevels colors;
    for (const auto& [color, level] : options.levelOfColor)
        if (const auto problem = colors.add(color, level))
            return fail(ErrorCode::badArgument, "levels of colours: " + *problem, name);
    return {};
}

Result<FractureMap> readFractureMap(const std::filesystem::path& path,
                                    const MapReadOptions& options) {
    const std::string extension = lowerExtension(path);
    const bool bitmap = extension == ".png" || extension == ".jpg" || extension == ".jpeg";
    if (!bitmap && extension != ".svg" && extension != ".json")
        return fail(ErrorCode::unsupported,
                    "fracture maps are read from .svg, .json, .png, .jpg and .jpeg files; this is "
                    "none of them",
                    path.string());
    const Result<std::string> text = readMapFile(path, kMap);
    if (!text) return tl::unexpected(text.error());
    const std::string name = path.filename().string();
    if (bitmap)
        return readBitmapMap({reinterpret_cast<const uint8_t*>(text->data()), text->size()}, name,
                             options);
    return extension == ".svg" ? readSvgMap(*text, name, options)
                               : readJsonMap(*text, name, options);
}

}  // namespace sherd
