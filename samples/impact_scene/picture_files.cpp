// SPDX-License-Identifier: MIT
#include "picture_files.h"

#include <stb/stb_image_write.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <string>

#include "sherd/formats/glb_write.h"

namespace sherd::samples {
namespace {

constexpr uint32_t kMargin = 4;

void paste(const Picture& from, uint32_t x, uint32_t y, Picture& to) {
    const size_t row = size_t{3} * from.width;
    for (uint32_t line = 0; line < from.height; ++line) {
        std::copy_n(&from.pixels[row * line], row,
                    &to.pixels[(size_t{y + line} * to.width + x) * 3]);
    }
}

/// In single quotes, as the shell wants it.
std::string quoted(const std::string& text) {
    std::string out = "'";
    for (const char c : text) {
        if (c == '\'') {
            out += "'\\''";
        } else {
            out += c;
        }
    }
    out += "'";
    return out;
}

}  // namespace

Picture shrink(const Picture& picture, uint32_t width) {
    const uint32_t height = std::max(1U, picture.height * width / picture.width);
    Picture out{width, height, std::vector<uint8_t>(size_t{3} * width * height)};
    for (uint32_t y = 0; y < height; ++y) {
        const uint32_t y0 = y * picture.height / height;
        const uint32_t y1 = std::max(y0 + 1, (y + 1) * picture.height / height);
        for (uint32_t x = 0; x < width; ++x) {
            const uint32_t x0 = x * picture.width / width;
            const uint32_t x1 = std::max(x0 + 1, (x + 1) * picture.width / width);
            for (uint32_t c = 0; c < 3; ++c) {
                uint32_t sum = 0;
                for (uint32_t v = y0; v < y1; ++v) {
                    for (uint32_t u = x0; u < x1; ++u)
                        sum += picture.pixels[(size_t{v} * picture.width + u) * 3 + c];
                }
                out.pixels[(size_t{y} * width + x) * 3 + c] =
                    static_cast<uint8_t>(sum / ((x1 - x0) * (y1 - y0)));
            }
        }
    }
    return out;
}

Picture contactSheet(std::span<const Picture> pictures, uint32_t columns) {
    Picture sheet;
    if (pictures.empty()) return sheet;
    const auto rows = static_cast<uint32_t>((pictures.size() + columns - 1) / columns);
    const uint32_t stepX = pictures[0].width + kMargin;
    const uint32_t stepY = pictures[0].height + kMargin;
    sheet.width = stepX * columns + kMargin;
    sheet.height = stepY * rows + kMargin;
    sheet.pixels.assign(size_t{3} * sheet.width * sheet.height, 24);
    for (uint32_t i = 0; i < pictures.size(); ++i) {
        paste(pictures[i], kMargin + i % columns * stepX, kMargin + i / columns * stepY, sheet);
    }
    return sheet;
}

Result<void> writePng(const std::filesystem::path& path, const Picture& picture) {
    std::vector<uint8_t> png;
    const auto append = [](void* context, void* data, int count) {
        auto& bytes = *static_cast<std::vector<uint8_t>*>(context);
        const auto* begin = static_cast<const uint8_t*>(data);
        bytes.insert(bytes.end(), begin, begin + count);
    };
    const auto width = static_cast<int>(picture.width);
    stbi_write_png_to_func(append, &png, width, static_cast<int>(picture.height), 3,
                           picture.pixels.data(), 3 * width);
    return writeFileWhole(path, png);
}

Result<std::unique_ptr<VideoWriter>> VideoWriter::open(const std::filesystem::path& path,
                                                       uint32_t width, uint32_t height,
                                                       uint32_t framesPerSecond) {
    if (std::system("command -v ffmpeg >/dev/null 2>&1") != 0) {
        return fail(ErrorCode::fileNotFound,
                    "the video needs the ffmpeg command: install ffmpeg, or pass --no-video",
                    "ffmpeg");
    }
    // A dead ffmpeg must end in an error message, not in a signal.
    std::signal(SIGPIPE, SIG_IGN);
    std::string command =
        "ffmpeg -hide_banner -loglevel error -y -f rawvideo -pix_fmt rgb24 -video_size ";
    command.append(std::to_string(width)).append("x").append(std::to_string(height));
    command.append(" -framerate ").append(std::to_string(framesPerSecond));
    command.append(
        " -i - -c:v libx264 -preset fast -crf 19 -pix_fmt yuv420p -movflags +faststart ");
    command.append(quoted(path.string()));
    std::unique_ptr<VideoWriter> self(new VideoWriter);
    self->path_ = path;
    self->pipe_ = popen(command.c_str(), "w");
    if (self->pipe_ == nullptr)
        return fail(ErrorCode::fileWrite, "ffmpeg does not start", path.string());
    return self;
}

VideoWriter::~VideoWriter() {
    if (pipe_ == nullptr) return;
    // Not finished: something failed, and half a film is none.
    pclose(pipe_);
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
}

Result<void> VideoWriter::add(const Picture& picture) {
    if (std::fwrite(picture.pixels.data(), 1, picture.pixels.size(), pipe_) !=
        picture.pixels.size()) {
        return fail(ErrorCode::fileWrite, "ffmpeg takes no more pictures; its own message is above",
                    path_.string());
    }
    return {};
}

Result<void> VideoWriter::finish() {
    const int status = pclose(pipe_);
    pipe_ = nullptr;
    if (status != 0)
        return fail(ErrorCode::fileWrite, "ffmpeg failed; its own message is above",
                    path_.string());
    return {};
}

}  // namespace sherd::samples
