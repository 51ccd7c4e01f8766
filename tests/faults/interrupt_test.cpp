// SPDX-License-Identifier: Apache-2.0
// Signals that ask a batch to end: it does so by that signal, and says what is left.
#include "assets.h"
#include "batch_folder.h"
#include "processes.h"
#include "sanitizer.h"

#include <chrono>
#include <csignal>
#include <ostream>
#include <random>

namespace spa::test {
namespace {

using Clock = std::chrono::steady_clock;

struct Case {
    const char* name;
    int signal;
    bool to_group; // as a terminal does

    friend void PrintTo(const Case& given, std::ostream* out) { *out << given.name; }
};

class InterruptBatch : public testing::TestWithParam<Case> {
protected:
    static void send(const Process& process) {
        ASSERT_EQ(kill(GetParam().to_group ? -process.id() : process.id(), GetParam().signal), 0);
    }

    const Orphanage orphanage_;
};

TEST_P(InterruptBatch, EndsTheBakesAndSaysWhatIsLeft) {
    BatchFolder folder;
    folder.add_slow("slow1.obj");
    folder.add_slow("slow2.obj");
    folder.add_slow("slow3.obj");
    for (const char* name : {"a.obj", "b.obj"}) folder.add(name, obj(1));
    Process process(folder.slow_batch({"--report", "report.json", "--report", "report.html"}), folder.path(),
                    "", {.leads_group = true});
    ASSERT_TRUE(process.until([&] { return children_of(process.id()).size() == 2; }));
    send(process);
    const Outcome outcome = process.wait();
    EXPECT_EQ(outcome.signal, GetParam().signal) << outcome.err;
    EXPECT_TRUE(says(outcome.err, "spa: interrupted; 5 assets are left, and the next run goes on there\n"));
    EXPECT_TRUE(says(outcome.out, "5 assets: 0 baked, 0 up to date, 0 failed, 5 not started"));
    EXPECT_TRUE(Orphanage::all_have_ended());
    EXPECT_EQ(folder.report()["stopped_by"], "signal");
    const nlohmann::json report = folder.report();
    for (const nlohmann::json& asset : report["assets"]) {
        EXPECT_EQ(asset["status"], "not_started");
        EXPECT_EQ(asset["exit_code"], nullptr);
        EXPECT_EQ(asset["error"], nullptr);
    }
    EXPECT_TRUE(says(read_file(folder.path() / "report.html"), "</html>"));
    EXPECT_TRUE(folder.maps_are_right());
    EXPECT_TRUE(folder.others().empty());
    EXPECT_EQ(folder.run().exit_code, 0);
    EXPECT_TRUE(folder.is_complete());
}

// Whatever a bake is about when the signal comes, it is not counted as failed.
TEST_P(InterruptBatch, AtAnyMoment) {
    BatchFolder folder;
    for (int i = 0; i < 12; ++i) folder.add(std::to_string(i / 3) + "/" + "abc"[i % 3] + ".obj", obj(i % 3));
    std::mt19937 random(std::uint32_t(GetParam().signal));
    int interrupted = 0;
    for (int round = 0; round < rounds(8); ++round) {
        SCOPED_TRACE(round);
        std::filesystem::remove_all(folder.out());
        Process process(folder.batch({"--report", "report.json"}), folder.path(), "", {.leads_group = true});
        process.until([&] { return !children_of(process.id()).empty(); });
        const auto moment = Clock::now() + std::chrono::microseconds(random() % 100'000);
        const bool sent = process.until([&] { return Clock::now() >= moment; });
        if (sent) send(process);
        const Outcome outcome = process.wait();
        ASSERT_TRUE(Orphanage::all_have_ended());
        ASSERT_TRUE(folder.maps_are_right());
        ASSERT_TRUE(folder.others().empty());
        const nlohmann::json report = folder.report();
        ASSERT_EQ(report["counts"]["failed"], 0) << report.dump(1);
        if (report["stopped_by"].is_null()) {
            ASSERT_EQ(report["counts"]["baked"], 12);
            continue;
        }
        ++interrupted;
        ASSERT_EQ(outcome.signal, GetParam().signal);
    }
    EXPECT_GT(interrupted, 0); // or nothing was tried
    EXPECT_EQ(folder.run().exit_code, 0);
    EXPECT_TRUE(folder.is_complete());
}

constexpr Case cases[] = {
    {"Interrupt", SIGINT, false},
    {"Terminate", SIGTERM, false},
    {"HangUp", SIGHUP, false},
    {"InterruptOfTheGroup", SIGINT, true},
};

INSTANTIATE_TEST_SUITE_P(Signals, InterruptBatch, testing::ValuesIn(cases),
                         [](const testing::TestParamInfo<Case>& given) { return given.param.name; });

// A bake that does not listen is no reason to wait for.
TEST(InterruptBatchWith, ABakeThatDoesNotListen) {
    const Orphanage orphanage;
    BatchFolder folder;
    folder.add_slow("slow.obj");
    folder.add("a.obj", obj(1));
    Process process(folder.slow_batch({"--report", "report.json"}), folder.path());
    ASSERT_TRUE(
        process.until([&] { return process.so_far().err.find("a.obj: baked") != std::string::npos; }));
    const std::vector<pid_t> children = children_of(process.id());
    ASSERT_EQ(children.size(), 1U);
    ASSERT_TRUE(signal_child(process.id(), children.front(), SIGSTOP));
    kill(process.id(), SIGINT);
    kill(process.id(), SIGINT); // impatient
    const Outcome outcome = process.wait();
    EXPECT_EQ(outcome.signal, SIGINT);
    EXPECT_TRUE(says(outcome.err, "spa: interrupted; 1 assets are left"));
    EXPECT_EQ(folder.report()["counts"]["not_started"], 1);
    EXPECT_EQ(folder.report()["counts"]["baked"], 1);
    EXPECT_TRUE(Orphanage::all_have_ended());
    EXPECT_TRUE(folder.others().empty());
    EXPECT_EQ(folder.run().exit_code, 0);
    EXPECT_TRUE(folder.is_complete());
}

// nohup and the like: what is ignored when the command starts stays so, for its bakes too.
TEST(InterruptBatchWith, SignalsThatAreIgnored) {
    BatchFolder folder;
    for (int i = 0; i < 20; ++i) folder.add(std::to_string(i) + "/a.obj", obj(1));
    Process process(folder.batch(), folder.path(), "",
                    {.leads_group = true, .ignored_signals = {SIGHUP, SIGINT}});
    ASSERT_TRUE(process.until([&] { return !children_of(process.id()).empty(); }));
    // Until some have ended, so that it meets bakes in all their states.
    while (process.so_far().err.find("[10/20]") == std::string::npos) {
        kill(-process.id(), SIGHUP);
        kill(-process.id(), SIGINT);
        std::size_t seen = process.so_far().err.size();
        ASSERT_TRUE(process.until([&] { return process.so_far().err.size() > seen; }));
    }
    const Outcome outcome = process.wait();
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_TRUE(folder.is_complete());
}

// The batch cannot tell its bakes when it is killed; the system does, from the first moment of each.
TEST(InterruptBatchWith, NobodyWhoTellsTheBakes) {
    const Orphanage orphanage;
    BatchFolder folder;
    folder.add_slow("slow1.obj");
    folder.add_slow("slow2.obj");
    for (int round = 0; round < rounds(4); ++round) {
        SCOPED_TRACE(round);
        Process process(folder.slow_batch(), folder.path());
        const std::size_t children = std::size_t(1 + round % 2);
        const auto are_there = [&] { return children_of(process.id()).size() >= children; };
        ASSERT_TRUE(process.until([&] {
            for (int look = 0; look < 1000; ++look) // at once when it is, and not a millisecond later
                if (are_there()) return true;
            return false;
        }));
        kill(process.id(), SIGKILL);
        process.wait();
        ASSERT_TRUE(Orphanage::all_have_ended());
        ASSERT_TRUE(folder.others().empty());
    }
    EXPECT_EQ(folder.run().exit_code, 0);
    EXPECT_TRUE(folder.is_complete());
}

} // namespace
} // namespace spa::test
