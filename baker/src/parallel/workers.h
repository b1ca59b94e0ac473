// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <vector>

namespace sherd {

/// Threads that stay from one piece of work to the next: to start one costs 60 us, and a bake has
/// hundreds of pieces that take less than a millisecond. They are started when first asked for and
/// joined at the end of the process.
class Workers {
  public:
    /// What several threads do at once. They divide it among themselves: whoever comes late finds
    /// nothing left to do.
    class Job {
      public:
        Job(void (*share)(void*), void* context) : share_(share), context_(context) {}

      private:
        friend class Workers;
        void (*share_)(void*);
        void* context_;
        unsigned places_ = 0;            ///< for workers that have not come yet
        std::atomic<unsigned> busy_{0};  ///< workers at it
    };

    Workers() = default;
    Workers(const Workers&) = delete;
    Workers& operator=(const Workers&) = delete;
    ~Workers();

    /// Those of the process.
    static Workers& shared();

    /// Does the job here and on at most so many workers; returns once nobody is at it. Workers busy
    /// with other jobs are not waited for, so jobs may have jobs done. What a job throws ends the
    /// process.
    void run(Job& job, unsigned others) noexcept;

    /// The two halves of `run`: workers begin, and the caller, too, takes its share of the job, and
    /// waits for them.
    void begin(Job& job, unsigned others) noexcept;
    void finish(Job& job) noexcept;

  private:
    void work() noexcept;
    Job* take();
    void leave(Job& job);
    void engage(unsigned others);

    std::mutex mutex_;  ///< of what follows, and of the jobs' numbers
    std::condition_variable news_, left_;
    std::vector<Job*> open_;
    std::vector<std::thread> threads_;
    bool ending_ = false;
    std::atomic<unsigned> jobs_{0};  ///< so far, so that workers see without the lock that one came
};

}  // namespace sherd
