// SPDX-License-Identifier: Apache-2.0
// kill -9, of the batch, of one of its bakes and of all, at any moment.
#include "assets.h"
#include "batch_folder.h"
#include "processes.h"
#include "sanitizer.h"

#include <array>
#include <chrono>
#include <csignal>
#include <fcntl.h>
#include <random>
#include <sys/file.h>
#include <unistd.h>

namespace spa::test {
namespace {

using Clock = std::chrono::steady_clock;

enum class Victim { batch, bake, all };

class Kill : public testing::TestWithParam<Victim> {
protected:
    Kill() {
        for (int i = 0; i < 12; ++i)
            folder_.add(std::to_string(i / 3) + "/" + "abc"[i % 3] + ".obj", obj(i % 3));
    }

    static bool has_child(const Process& process) { return !children_of(process.id()).empty(); }

    // From the first bake to the end.
    Clock::duration measure() {
        Process process(folder_.batch(), folder_.path());
        process.until([&] { return has_child(process); });
        const Clock::time_point start = Clock::now();
        EXPECT_EQ(process.wait().exit_code, 0);
        const Clock::duration time = Clock::now() - start;
        EXPECT_TRUE(folder_.is_complete());
        return time;
    }

    // Kills; false if there was nothing to kill.
    bool kill_now(Process& process) {
        if (GetParam() == Victim::batch) return kill(process.id(), SIGKILL) == 0;
        if (GetParam() == Victim::bake) {
            std::vector<pid_t> children;
            if (!process.until([&] { return !(children = children_of(process.id())).empty(); })) return false;
            return signal_child(process.id(), children[random_() % children.size()], SIGKILL);
        }
        kill(process.id(), SIGSTOP); // so that it does not clear away what the children leave
        for (const pid_t child : children_of(process.id())) signal_child(process.id(), child, SIGKILL);
        return kill(process.id(), SIGKILL) == 0;
    }

    BatchFolder folder_;
    std::mt19937 random_{std::uint32_t(GetParam()) + 1};
    const Orphanage orphanage_;
};

TEST_P(Kill, AtAnyMomentLeavesWholeMapsAndTheNextRunGoesOn) {
    constexpr int tries = rounds(35);
    const Clock::duration time = measure();
    int cut_short = 0;
    for (int round = 0; round < tries; ++round) {
        SCOPED_TRACE(round);
        std::filesystem::remove_all(folder_.out());
        Process process(folder_.batch(), folder_.path());
        // Some while it starts, most while it bakes.
        if (round % 6 != 0) process.until([&] { return has_child(process); });
        const auto moment =
            Clock::now() + std::chrono::nanoseconds(std::uniform_int_distribution<std::int64_t>(
                               0, std::chrono::nanoseconds(time).count())(random_));
        const bool killed = process.until([&] { return Clock::now() >= moment; }) && kill_now(process);
        const Outcome outcome = process.wait();
        ASSERT_TRUE(Orphanage::all_have_ended());
        ASSERT_TRUE(folder_.maps_are_right());
        if (GetParam() == Victim::bake || !killed) {
            // A bake that was killed is done again: it may have been for want of memory.
            ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
            ASSERT_TRUE(folder_.is_complete());
            cut_short += killed ? 1 : 0;
        } else {
            cut_short += outcome.signal == SIGKILL ? 1 : 0;
        }
        for (const std::string& name : folder_.others()) // the documented ones
            ASSERT_TRUE(name.find("/.") != std::string::npos && name.find(".spa.") != std::string::npos)
                << name;
        ASSERT_EQ(folder_.run().exit_code, 0);
        ASSERT_TRUE(folder_.is_complete());
    }
    EXPECT_GT(cut_short, tries / 2); // or nothing was tried
}

std::string victim_name(const testing::TestParamInfo<Victim>& victim) {
    constexpr std::array names{"Batch", "Bake", "All"};
    return names[std::size_t(victim.param)];
}

INSTANTIATE_TEST_SUITE_P(Victims, Kill, testing::Values(Victim::batch, Victim::bake, Victim::all),
                         victim_name);

// What a killed process leaves is not locked; what another one is about to write is.
TEST(Leftovers, AreRemovedButForThoseInUse) {
    BatchFolder folder;
    const std::string long_name(250, 'n');
    folder.add("a.obj", obj(1));
    folder.add("sub/" + long_name + ".obj", obj(2));
    const std::string left = ".a.spa.Aa0Zz9", long_left = "sub/." + long_name.substr(0, 200) + ".abcdef";
    const std::string in_use = ".a.spa.in_use", others = ".a.obj.abcdef", users = ".a.spa.backup1";
    std::filesystem::create_directories(folder.out("sub"));
    for (const std::string& name : {left, long_left, in_use, others, users})
        write_file(folder.out(name), "half");
    const int descriptor = open(folder.out(in_use).c_str(), O_RDONLY | O_CLOEXEC);
    ASSERT_EQ(flock(descriptor, LOCK_EX | LOCK_NB), 0);
    const Outcome outcome = folder.run();
    close(descriptor);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_TRUE(folder.maps_are_right());
    EXPECT_EQ(folder.others(), (std::vector<std::string>{others, users, in_use}));
}

} // namespace
} // namespace spa::test
