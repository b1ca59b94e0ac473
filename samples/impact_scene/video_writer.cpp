// SPDX-License-Identifier: MIT
#include "video_writer.h"

#include <csignal>
#include <cstdlib>
#include <string>

namespace sherd::samples {
namespace {

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
