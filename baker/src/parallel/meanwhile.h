// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <optional>
#include <utility>

#include "parallel/workers.h"

namespace sherd {

/// A result that a worker makes while the caller does something else; if none has time for it, the
/// caller makes it when it asks. `threads` below 2: always the caller. The task must not throw.
template <class Task>
class Meanwhile {
  public:
    using Value = decltype(std::declval<Task&>()());

    Meanwhile(unsigned threads, Task task)
        : task_(std::move(task)),
          job_([](void* self) { static_cast<Meanwhile*>(self)->make(); }, this) {
        Workers::shared().begin(job_, threads > 1 ? 1 : 0);
    }
    Meanwhile(const Meanwhile&) = delete;
    Meanwhile& operator=(const Meanwhile&) = delete;
    ~Meanwhile() {
        if (!isFinished_) Workers::shared().finish(job_);
    }

    /// The same every time.
    const Value& get() {
        if (!isFinished_) Workers::shared().finish(job_);
        isFinished_ = true;
        return *value_;
    }

  private:
    void make() {
        if (!isTaken_.exchange(true)) value_.emplace(task_());
    }

    Task task_;
    std::atomic<bool> isTaken_{false};
    std::optional<Value> value_;
    bool isFinished_ = false;
    Workers::Job job_;
};

}  // namespace sherd
