// SPDX-License-Identifier: MIT
#include "parallel/workers.h"

#include <algorithm>
#include <chrono>
#include <system_error>

namespace sherd {
namespace {

constexpr unsigned kMostThreads = 255;

/// Whether the condition comes true soon. Jobs follow each other by some microseconds, and waking a
/// thread takes longer; whoever else wants the processor gets it meanwhile.
template <class Condition>
bool soon(const Condition& condition) {
    constexpr std::chrono::microseconds kPatience{100};
    const auto end = std::chrono::steady_clock::now() + kPatience;
    while (!condition()) {
        if (std::chrono::steady_clock::now() > end) return false;
        std::this_thread::yield();
    }
    return true;
}

}  // namespace

Workers& Workers::shared() {
    static Workers workers;
    return workers;
}

Workers::~Workers() {
    {
        const std::lock_guard lock(mutex_);
        ending_ = true;
        ++jobs_;
    }
    news_.notify_all();
    for (std::thread& thread : threads_) thread.join();
}

void Workers::run(Job& job, unsigned others) noexcept {
    begin(job, others);
    finish(job);
}

void Workers::begin(Job& job, unsigned others) noexcept {
    {
        const std::lock_guard lock(mutex_);
        engage(others);
        job.places_ = others;
        open_.push_back(&job);
        ++jobs_;
    }
    news_.notify_all();
}

void Workers::finish(Job& job) noexcept {
    job.share_(job.context_);
    {
        const std::lock_guard lock(mutex_);
        open_.erase(std::find(open_.begin(), open_.end(), &job));
    }
    const auto isLeft = [&job] { return job.busy_ == 0; };
    if (soon(isLeft)) return;
    std::unique_lock lock(mutex_);
    left_.wait(lock, isLeft);
}

/// Where the system has no more threads to give, those there are have to do.
void Workers::engage(unsigned others) {
    try {
        while (threads_.size() < std::min(others, kMostThreads))
            threads_.emplace_back([this] { work(); });
    } catch (const std::system_error&) {
        return;
    }
}

/// The oldest job with a place, or none.
Workers::Job* Workers::take() {
    for (Job* job : open_) {
        if (job->places_ == 0) continue;
        --job->places_;
        ++job->busy_;
        return job;
    }
    return nullptr;
}

/// The job may be gone as soon as its last worker has left.
void Workers::leave(Job& job) {
    {
        const std::lock_guard lock(mutex_);
        --job.busy_;
    }
    left_.notify_all();
}

void Workers::work() noexcept {
    std::unique_lock lock(mutex_);
    while (!ending_) {
        if (Job* job = take()) {
            lock.unlock();
            job->share_(job->context_);
            leave(*job);
            lock.lock();
            continue;
        }
        const unsigned seen = jobs_;
        const auto hasNews = [this, seen] { return jobs_ != seen; };
        lock.unlock();
        const bool came = soon(hasNews);
        lock.lock();
        if (!came) news_.wait(lock, hasNews);
    }
}

}  // namespace sherd
