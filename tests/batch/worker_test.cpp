// SPDX-License-Identifier: Apache-2.0
#include "../../tools/worker.h"

#include <gtest/gtest.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <new>
#include <sys/wait.h>
#include <unistd.h>

#if defined(__SANITIZE_ADDRESS__)
#define SPA_ADDRESS_SANITIZER
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define SPA_ADDRESS_SANITIZER
#endif
#endif

namespace spa::test {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using tools::WorkerEnd;
using tools::WorkerLimits;
using tools::WorkerPool;

constexpr WorkerLimits roomy{std::uint64_t(1) << 30U, {}};

WorkerEnd wait_for_one(WorkerPool& pool) {
    for (;;)
        if (std::optional<WorkerEnd> end = pool.wait(milliseconds(100))) return std::move(*end);
}

WorkerEnd run(const std::function<std::string()>& task, const WorkerLimits& limits = roomy) {
    WorkerPool pool;
    pool.start(7, task, limits);
    WorkerEnd end = wait_for_one(pool);
    EXPECT_EQ(end.id, 7U);
    EXPECT_EQ(pool.running(), 0U);
    return end;
}

TEST(Worker, ReturnsWhatItsTaskReturns) {
    std::string bytes(1'000'000, 'x');
    bytes[5] = '\0';
    const WorkerEnd end = run([&] { return bytes; });
    EXPECT_TRUE(end.completed);
    EXPECT_EQ(end.signal, 0);
    EXPECT_TRUE(end.result == bytes);
    EXPECT_EQ(end.diagnostics, "");
    EXPECT_GT(end.peak_memory_bytes, 0U);
}

TEST(Worker, KeepsTheEndOfWhatIsPrinted) {
    const WorkerEnd end = run([] {
        std::fprintf(stderr, "%s", std::string(100'000, 'a').c_str());
        std::printf("the end");
        std::fflush(stdout);
        return std::string("result");
    });
    EXPECT_EQ(end.result, "result");
    EXPECT_EQ(end.diagnostics.size(), 2048U);
    EXPECT_TRUE(end.diagnostics.ends_with("aaathe end"));
}

TEST(Worker, StandardInputIsEmpty) {
    EXPECT_EQ(run([] { return std::to_string(std::getchar()); }).result, std::to_string(EOF));
}

TEST(Worker, CrashesAreTold) {
    const WorkerEnd crash = run([]() -> std::string {
        static_cast<void>(std::signal(SIGSEGV, SIG_DFL)); // sanitizers have a handler
        static_cast<void>(std::raise(SIGSEGV));
        return "survived";
    });
    EXPECT_FALSE(crash.completed);
    EXPECT_EQ(crash.signal, SIGSEGV);
    const WorkerEnd exit = run([]() -> std::string { _exit(3); });
    EXPECT_FALSE(exit.completed);
    EXPECT_EQ(exit.signal, 0);
}

TEST(Worker, WhatEndsLateIsAskedThenKilled) {
    const WorkerLimits short_time{roomy.memory_bytes, seconds(1)};
    const WorkerEnd polite = run(
        []() -> std::string {
            for (;;) pause();
        },
        short_time);
    EXPECT_TRUE(polite.timed_out);
    EXPECT_EQ(polite.signal, SIGTERM);
    const WorkerEnd stubborn = run(
        []() -> std::string {
            static_cast<void>(std::signal(SIGTERM, SIG_IGN));
            for (;;) pause();
        },
        short_time);
    EXPECT_TRUE(stubborn.timed_out);
    EXPECT_EQ(stubborn.signal, SIGKILL);
}

TEST(Worker, MemoryBeyondTheLimitIsRefused) {
#ifdef SPA_ADDRESS_SANITIZER
    GTEST_SKIP() << "AddressSanitizer's allocator ends the process instead";
#else
    const auto take = [](std::size_t bytes) {
        return [bytes]() -> std::string {
            try {
                const std::string taken(bytes, 'x');
                return taken.substr(bytes - 4);
            } catch (const std::bad_alloc&) {
                return "refused";
            }
        };
    };
    const WorkerLimits limits{std::uint64_t(64) << 20U, {}};
    EXPECT_EQ(run(take(std::size_t(16) << 20U), limits).result, "xxxx");
    EXPECT_EQ(run(take(std::size_t(128) << 20U), limits).result, "refused");
#endif
}

TEST(Worker, ManyAtOnce) {
    WorkerPool pool;
    for (std::size_t i = 0; i < 20; ++i)
        pool.start(
            i, [i] { return std::string(i * 10'000, char('a' + i)); }, roomy);
    EXPECT_EQ(pool.running(), 20U);
    std::map<std::size_t, std::string> results;
    while (pool.running() > 0)
        if (const std::optional<WorkerEnd> end = pool.wait(seconds(1))) results[end->id] = end->result;
    ASSERT_EQ(results.size(), 20U);
    for (const auto& [id, result] : results) EXPECT_TRUE(result == std::string(id * 10'000, char('a' + id)));
}

TEST(Worker, NobodyOutlivesThePool) {
    pid_t child = 0;
    {
        WorkerPool pool;
        pool.start(
            0,
            []() -> std::string {
                std::printf("%d\n", getpid());
                std::fflush(stdout);
                for (;;) pause();
            },
            roomy);
        pool.signal_all(0);
        EXPECT_FALSE(pool.wait(milliseconds(0)));
        EXPECT_EQ(pool.running(), 1U);
        child = waitpid(-1, nullptr, WNOHANG);
        EXPECT_EQ(child, 0) << "it ended by itself";
    }
    EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1);
    EXPECT_EQ(errno, ECHILD);
}

} // namespace
} // namespace spa::test
