// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "sherd/formats/result.h"

namespace sherd::samples {

/// An OpenGL 3.3 core context without a window or display server, current on the calling thread
/// while it lives.
class OffscreenContext {
  public:
    static Result<std::unique_ptr<OffscreenContext>> create();
    ~OffscreenContext();
    OffscreenContext(const OffscreenContext&) = delete;
    OffscreenContext& operator=(const OffscreenContext&) = delete;

  private:
    OffscreenContext() = default;

    void* display_ = nullptr;
    void* context_ = nullptr;
};

}  // namespace sherd::samples
