// SPDX-License-Identifier: Apache-2.0
// Several runs on one output folder at once.
#include "assets.h"
#include "batch_folder.h"
#include "processes.h"

#include <csignal>
#include <list>
#include <utility>

namespace spa::test {
namespace {

class Together : public testing::Test {
protected:
    Together() {
        for (int i = 0; i < 12; ++i)
            folder_.add(std::to_string(i / 3) + "/" + "abc"[i % 3] + ".obj", obj(i % 3));
    }

    void run(std::size_t count, const std::vector<std::string>& more) {
        std::list<Process> runs;
        for (std::size_t i = 0; i < count; ++i) runs.emplace_back(folder_.batch(more), folder_.path());
        for (Process& one : runs) {
            const Outcome outcome = one.wait();
            EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
            EXPECT_TRUE(says(outcome.out, " 0 failed"));
        }
        EXPECT_TRUE(folder_.is_complete());
    }

    BatchFolder folder_;
};

TEST_F(Together, Two) {
    for (int round = 0; round < 3; ++round) {
        std::filesystem::remove_all(folder_.out());
        run(2, {});
    }
    EXPECT_TRUE(says(folder_.run().out, "12 up to date"));
}

TEST_F(Together, FourThatBakeEverything) {
    run(4, {"--force"});
    EXPECT_TRUE(says(folder_.run().out, "12 up to date"));
}

// One is killed again and again, and clears away what is left when it starts; the other is none the wiser.
TEST_F(Together, WithOneThatIsKilled) {
    const Orphanage orphanage;
    for (int i = 0; i < 60; ++i) folder_.add("more/" + std::to_string(i) + "/a.obj", obj(1));
    Process steady(folder_.batch(), folder_.path());
    bool has_ended = false;
    while (!has_ended) {
        Process killed(folder_.batch({"--force"}), folder_.path());
        killed.until([&] { return children_of(killed.id()).size() == 2; });
        kill(killed.id(), SIGKILL);
        killed.wait();
        bool looked = false;
        has_ended = !steady.until([&] { return std::exchange(looked, true); });
    }
    const Outcome outcome = steady.wait();
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    ASSERT_TRUE(Orphanage::all_have_ended());
    EXPECT_TRUE(folder_.maps_are_right());
    EXPECT_EQ(folder_.run().exit_code, 0);
    EXPECT_TRUE(folder_.is_complete());
}

} // namespace
} // namespace spa::test
