// SPDX-License-Identifier: Apache-2.0
// A bake that crashes, is killed or takes too long costs one asset, and the batch goes on.
#include "assets.h"
#include "batch_folder.h"
#include "processes.h"
#include "sanitizer.h"

#include <algorithm>
#include <csignal>
#include <cstdlib>

namespace spa::test {
namespace {

class Crash : public testing::Test {
protected:
    Crash() {
        folder_.add_slow("slow.obj");
        for (const char* name : {"a.obj", "b.obj", "sub/c.obj"}) folder_.add(name, obj(1));
        if (!is_sanitized) return;
        // Its handler would report the signal and let the process end by itself.
        const char* const options = std::getenv("ASAN_OPTIONS");
        setenv("ASAN_OPTIONS", (std::string(options == nullptr ? "" : options) + ":handle_segv=0").c_str(),
               1);
    }

    // The bake of the slow asset when it alone is left, but for the one of this number before.
    static pid_t slow_bake(Process& process, pid_t before = 0) {
        pid_t bake = 0;
        process.until([&] {
            const std::vector<pid_t> children = children_of(process.id());
            if (process.so_far().err.find("[3/4]") == std::string::npos || children.size() != 1) return false;
            bake = children.front();
            return bake != before;
        });
        return bake;
    }

    // Checks all but what the slow asset's failure is, which is returned.
    nlohmann::json failure(const Outcome& outcome) {
        EXPECT_TRUE(Orphanage::all_have_ended());
        EXPECT_TRUE(folder_.maps_are_right());
        EXPECT_TRUE(folder_.others().empty());
        const nlohmann::json report = folder_.report();
        EXPECT_EQ(report["stopped_by"], nullptr);
        EXPECT_EQ(report["counts"]["baked"], 3);
        EXPECT_EQ(report["counts"]["failed"], 1);
        nlohmann::json asset = asset_of(report, "slow.obj");
        EXPECT_EQ(asset["status"], "failed");
        EXPECT_EQ(asset["exit_code"], outcome.exit_code);
        EXPECT_TRUE(says(outcome.err, "slow.obj: failed, exit " + std::to_string(outcome.exit_code) + ": " +
                                          asset["error"].get<std::string>()));
        EXPECT_TRUE(says(outcome.err, "spa: 1 of 4 assets failed\n"));
        EXPECT_EQ(folder_.run().exit_code, 0);
        EXPECT_TRUE(folder_.is_complete());
        return asset;
    }

    // Sends the signal to the bake of the slow asset, and to the second try.
    Outcome end_twice(int signal, const Surroundings& surroundings = {}) {
        Process process(folder_.slow_batch({"--report", "report.json"}), folder_.path(), "", surroundings);
        const pid_t first = slow_bake(process);
        EXPECT_TRUE(signal_child(process.id(), first, signal));
        const pid_t second = slow_bake(process, first);
        EXPECT_TRUE(signal_child(process.id(), second, signal));
        return process.wait();
    }

    BatchFolder folder_;
    const Orphanage orphanage_;
};

TEST_F(Crash, IsReportedAfterASecondTry) {
    const Outcome outcome = end_twice(SIGSEGV);
    EXPECT_EQ(outcome.exit_code, 4);
    const nlohmann::json asset = failure(outcome);
    EXPECT_EQ(asset["signal"], "SIGSEGV");
    EXPECT_EQ(asset["error"], "in/slow.obj: crashed (SIGSEGV)");
}

TEST_F(Crash, OfABakeThatTheSystemKills) {
    const Outcome outcome = end_twice(SIGKILL);
    EXPECT_EQ(outcome.exit_code, 5);
    const nlohmann::json asset = failure(outcome);
    EXPECT_EQ(asset["signal"], "SIGKILL");
    EXPECT_TRUE(says(asset["error"],
                     "in/slow.obj: was killed (SIGKILL), as the system does when it is out of memory"));
}

// Some programs ignore SIGCHLD, and what they start inherits that: then the system forgets how a process
// ended.
TEST_F(Crash, WhereEndsOfChildrenWereIgnored) {
    const Outcome outcome = end_twice(SIGSEGV, {.ignored_signals = {SIGCHLD}});
    EXPECT_EQ(outcome.exit_code, 4);
    EXPECT_EQ(failure(outcome)["signal"], "SIGSEGV");
}

// Somebody ends one bake politely. It is not the batch that is meant.
TEST_F(Crash, OfABakeThatIsAskedToEnd) {
    Process process(folder_.slow_batch({"--report", "report.json"}), folder_.path());
    EXPECT_TRUE(signal_child(process.id(), slow_bake(process), SIGTERM));
    const Outcome outcome = process.wait();
    EXPECT_EQ(outcome.exit_code, 4);
    EXPECT_EQ(failure(outcome)["error"], "in/slow.obj: was ended by somebody else (SIGTERM)");
}

TEST_F(Crash, TooLong) {
    const Outcome outcome =
        run_spa(folder_.slow_batch({"--timeout", "1", "--report", "report.json"}), folder_.path());
    EXPECT_EQ(outcome.exit_code, 6);
    const nlohmann::json asset = failure(outcome);
    EXPECT_EQ(asset["error"], "in/slow.obj: took longer than 1 s (--timeout)");
    EXPECT_GE(asset["seconds"], 1);
    EXPECT_EQ(folder_.report()["timeout_seconds"], 1);
}

TEST_F(Crash, TooLongAndDeaf) {
    Process process(folder_.slow_batch({"--timeout", "5", "--report", "report.json"}), folder_.path());
    ASSERT_TRUE(signal_child(process.id(), slow_bake(process), SIGSTOP));
    const Outcome outcome = process.wait();
    EXPECT_EQ(outcome.exit_code, 6);
    EXPECT_EQ(failure(outcome)["signal"], "SIGKILL");
}

} // namespace
} // namespace spa::test
