// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "picture.h"
#include "sherd/formats/result.h"

namespace sherd::samples {

/// An MP4 written by the `ffmpeg` command, fed raw pictures. Unless finished, no file is left.
class VideoWriter {
  public:
    static Result<std::unique_ptr<VideoWriter>> open(const std::filesystem::path& path,
                                                     uint32_t width, uint32_t height,
                                                     uint32_t framesPerSecond);
    ~VideoWriter();
    VideoWriter(const VideoWriter&) = delete;
    VideoWriter& operator=(const VideoWriter&) = delete;

    Result<void> add(const Picture& picture);
    Result<void> finish();

  private:
    VideoWriter() = default;

    std::filesystem::path path_;
    std::FILE* pipe_ = nullptr;
};

}  // namespace sherd::samples
