// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <thread>
#include <vector>

#include "parallel/meanwhile.h"
#include "parallel/parallel_for.h"

using namespace sherd;

namespace {

/// How often each of so many items was worked on.
std::vector<int> visitsOf(size_t count, size_t grain, unsigned threads) {
    std::vector<int> visits(count, 0);
    parallelRuns(count, grain, threads, [&](size_t first, size_t last) {
        for (size_t i = first; i < last; ++i) ++visits[i];
    });
    return visits;
}

bool isAllOnes(const std::vector<int>& visits) {
    return std::count(visits.begin(), visits.end(), 1) ==
           static_cast<std::ptrdiff_t>(visits.size());
}

}  // namespace

TEST_CASE("no items are no work") {
    for (const unsigned threads : {0U, 1U, 8U})
        parallelRuns(0, 4, threads, [](size_t, size_t) { FAIL("there is nothing to do"); });
}

TEST_CASE("every item is worked on once, whatever the grain and the number of threads") {
    for (const size_t count : {1U, 2U, 7U, 1000U})
        for (const size_t grain : {0U, 1U, 3U, 5000U})
            for (const unsigned threads : {0U, 1U, 2U, 3U, 16U, 1000U})
                CHECK(isAllOnes(visitsOf(count, grain, threads)));
}

TEST_CASE("no more threads are at it than allowed") {
    std::atomic<int> atIt{0}, most{0};
    parallelRuns(64, 1, 3, [&](size_t, size_t) {
        const int now = ++atIt;
        for (int seen = most; now > seen && !most.compare_exchange_weak(seen, now);) {
        }
        std::this_thread::sleep_for(std::chrono::microseconds(100));
        --atIt;
    });
    CHECK(most <= 3);
    CHECK(most >= 1);
}

TEST_CASE("runs that wait for each other get threads of their own") {
    std::atomic<int> arrived{0};
    parallelRuns(3, 1, 3, [&](size_t, size_t) {
        ++arrived;
        while (arrived < 3) std::this_thread::yield();
    });
    CHECK(arrived == 3);
}

TEST_CASE("parallel work within parallel work comes to an end") {
    std::vector<std::atomic<int>> visits(40UL * 50);
    parallelRuns(40, 1, 4, [&](size_t outer, size_t) {
        parallelRuns(50, 1, 4, [&](size_t inner, size_t) { ++visits[50 * outer + inner]; });
    });
    CHECK(std::all_of(visits.begin(), visits.end(), [](const auto& n) { return n == 1; }));
}

TEST_CASE("several threads ask for parallel work at the same time") {
    std::vector<int> wrong(4, 0);
    std::vector<std::thread> callers;
    callers.reserve(wrong.size());
    for (int& count : wrong) {
        callers.emplace_back([&count] {
            for (int i = 0; i < 200; ++i) count += isAllOnes(visitsOf(100, 7, 3)) ? 0 : 1;
        });
    }
    for (std::thread& caller : callers) caller.join();
    CHECK(std::count(wrong.begin(), wrong.end(), 0) == 4);
}

TEST_CASE("workers wake up for work that comes after a pause") {
    for (int i = 0; i < 5; ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
        CHECK(isAllOnes(visitsOf(10, 1, 2)));
    }
}

TEST_CASE("tasks are done once each, in whatever order") {
    for (const unsigned threads : {1U, 2U, 8U}) {
        int a = 0, b = 0, c = 0;
        parallelTasks(
            threads, [&] { a += 1; }, [&] { b += 2; }, [&] { c += 3; });
        CHECK(a == 1);
        CHECK(b == 2);
        CHECK(c == 3);
    }
}

TEST_CASE("what is made meanwhile is there when asked for, whoever made it") {
    for (const unsigned threads : {1U, 2U}) {
        int made = 0;
        Meanwhile later(threads, [&] { return ++made; });
        CHECK(later.get() == 1);
        CHECK(later.get() == 1);
        CHECK(made == 1);
    }
}

TEST_CASE("what is made meanwhile lives as long as it needs, even if nobody asks") {
    for (int i = 0; i < 100; ++i) {
        std::vector<int> values(10, 1);
        const Meanwhile later(2, [&values] { return std::count(values.begin(), values.end(), 1); });
    }
}
