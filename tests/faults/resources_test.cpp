// SPDX-License-Identifier: Apache-2.0
// Too little of what a machine has: memory, descriptors, file size; and many assets.
#include "assets.h"
#include "batch_folder.h"
#include "sanitizer.h"

#include <algorithm>

namespace spa::test {
namespace {

constexpr rlim_t mebibyte = rlim_t(1) << 20U;

class Memory : public testing::Test {
protected:
    void SetUp() override {
        if (is_sanitized) GTEST_SKIP() << no_memory_limits;
        for (const char* name : {"a.obj", "huge.obj", "sub/b.obj"}) folder_.add(name, obj(1));
    }

    void expect_one_failure(const Outcome& outcome) {
        EXPECT_EQ(outcome.exit_code, 5) << outcome.err;
        EXPECT_TRUE(folder_.maps_are_right());
        EXPECT_TRUE(folder_.others().empty());
        const nlohmann::json report = folder_.report();
        EXPECT_EQ(report["counts"]["baked"], 2);
        EXPECT_EQ(report["counts"]["failed"], 1);
        const nlohmann::json asset = asset_of(report, "huge.obj");
        EXPECT_EQ(asset["exit_code"], 5);
        EXPECT_EQ(asset["signal"], nullptr);
        EXPECT_EQ(asset["error"], "in/huge.obj: out of memory; bake smaller maps or fewer layers");
        EXPECT_TRUE(says(outcome.err, "huge.obj: failed, exit 5: in/huge.obj: out of memory"));
        EXPECT_EQ(folder_.run().exit_code, 0);
        EXPECT_TRUE(folder_.is_complete());
    }

    // Needs some 800 MiB.
    [[nodiscard]] std::vector<std::string> huge_batch(const std::vector<std::string>& more) const {
        return folder_.batch_with("huge*", {{"size", 2048}}, more);
    }

    BatchFolder folder_;
};

TEST_F(Memory, BeyondThatOfAllIsRefused) {
    expect_one_failure(run_spa(huge_batch({"--memory", "256M", "--report", "report.json"}), folder_.path()));
}

// ulimit -v
TEST_F(Memory, BeyondThatOfTheShellIsRefused) {
    expect_one_failure(run_spa(huge_batch({"--report", "report.json"}), folder_.path(), "",
                               {.limits = {{RLIMIT_AS, 1024 * mebibyte}}}));
}

// Threads take memory for their stacks. A bake that gets none for them goes on with fewer, or fails as for
// any other want of memory.
TEST_F(Memory, ForThreads) {
    const Outcome outcome = run_spa(
        folder_.batch({"--threads", "64", "--memory", "256M", "--report", "report.json"}), folder_.path());
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_TRUE(folder_.is_complete());
}

// The bakes of a batch hold two descriptors each.
TEST(Descriptors, TooFewForAllJobsAreEnoughForSome) {
    if (is_sanitized)
        GTEST_SKIP() << "UndefinedBehaviorSanitizer takes what it needs a descriptor for as wrong";
    BatchFolder folder;
    for (int i = 0; i < 30; ++i) folder.add(std::to_string(i) + "/a.obj", obj(1));
    const Outcome outcome = run_spa({"batch", "in", "-o", "out", "--size", "16", "--jobs", "16"},
                                    folder.path(), "", {.limits = {{RLIMIT_NOFILE, 20}}});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_TRUE(folder.is_complete());
}

class ClosedStreams : public testing::TestWithParam<std::vector<int>> {};

// The first files that are opened would take their numbers.
TEST_P(ClosedStreams, TakeNoFile) {
    BatchFolder folder;
    for (const char* name : {"a.obj", "b.obj", "c.obj"}) folder.add(name, obj(1));
    folder.add("bad.obj", "nothing");
    const Outcome outcome = folder.run({"--report", "report.json"}, {.closed = GetParam()});
    const bool has_output = std::count(GetParam().begin(), GetParam().end(), 1) == 0;
    const bool has_errors = std::count(GetParam().begin(), GetParam().end(), 2) == 0;
    EXPECT_EQ(outcome.exit_code, has_output ? 3 : 2);
    EXPECT_EQ(outcome.out.find("4 assets: 3 baked") != std::string::npos, has_output);
    EXPECT_EQ(outcome.err.find("bad.obj: failed, exit 3") != std::string::npos, has_errors);
    EXPECT_EQ(outcome.err.find("standard output cannot be written") != std::string::npos,
              has_errors && !has_output);
    EXPECT_EQ(folder.report()["counts"]["baked"], 3);
    folder.forget("bad.obj");
    EXPECT_TRUE(folder.is_complete());
}

INSTANTIATE_TEST_SUITE_P(Streams, ClosedStreams,
                         testing::Values(std::vector<int>{0}, std::vector<int>{1}, std::vector<int>{2},
                                         std::vector<int>{0, 1, 2}));

// ulimit -f
TEST(FileSize, BeyondTheLimitFails) {
    BatchFolder folder;
    folder.add("a.obj", obj(1));
    folder.add("b.obj", obj(1));
    const Outcome outcome = folder.run({}, {.limits = {{RLIMIT_FSIZE, 1024}}});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_TRUE(says(outcome.err, "a.obj: failed, exit 2: out/a.spa: cannot be written: File too large"));
    EXPECT_TRUE(folder.maps_are_right());
    EXPECT_TRUE(folder.others().empty());
    EXPECT_EQ(folder.run().exit_code, 0);
    EXPECT_TRUE(folder.is_complete());
}

// The memory of a batch does not grow with its assets.
TEST(ManyAssets, TakeNoMoreMemoryThanFew) {
    if (is_sanitized) GTEST_SKIP() << no_memory_limits;
    const auto peaks = [](int count) {
        BatchFolder folder({"--size", "4"});
        for (int i = 0; i < count; ++i) folder.add(std::to_string(i) + "/a.obj", obj(1));
        const Outcome bake = folder.run({"-q"});
        EXPECT_EQ(bake.exit_code, 0) << bake.err;
        EXPECT_TRUE(says(bake.out, std::to_string(count) + " assets: " + std::to_string(count) + " baked"));
        EXPECT_TRUE(folder.is_complete());
        const Outcome look = folder.run({"-q"});
        EXPECT_TRUE(says(look.out, std::to_string(count) + " up to date"));
        return std::pair(bake.peak_kibibytes, look.peak_kibibytes);
    };
    const auto [few_bake, few_look] = peaks(50);
    const auto [many_bake, many_look] = peaks(1000);
    std::printf("peak memory of 50 and of 1000 assets: %ld and %ld KiB; up to date: %ld and %ld KiB\n",
                few_bake, many_bake, few_look, many_look);
    EXPECT_LT(many_bake, few_bake + 4096);
    EXPECT_LT(many_look, few_look + 4096);
}

} // namespace
} // namespace spa::test
