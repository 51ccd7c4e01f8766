// SPDX-License-Identifier: Apache-2.0
#include "process.h"

#include <gtest/gtest.h>

#include <csignal>

namespace spa::test {
namespace {

class Interrupt : public testing::TestWithParam<int> {};

// One draw call a view for every sample takes hours, so the first line of progress surely comes before the
// end.
TEST_P(Interrupt, LongBakeLeavesNothingBehind) {
    const TemporaryFolder folder;
    ASSERT_EQ(run_spa({"sample", "boot", "--level", "4", "-o", "boot.glb"}, folder.path()).exit_code, 0);
    write_file(folder.path() / "boot.spa", "as it was");
    const Outcome outcome = interrupt_spa(
        {"bake", "boot.glb", "-o", "boot.spa", "--paper", "--baker", "orbit", "--gl", "osmesa", "--gl-naive"},
        folder.path(), GetParam());
    EXPECT_EQ(outcome.signal, GetParam()) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_NE(outcome.err.find("spa: baking boot.glb:"), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find("spa: interrupted; nothing was written"), std::string::npos) << outcome.err;
    EXPECT_EQ(folder.names(), (std::vector<std::string>{"boot.glb", "boot.spa"}));
    EXPECT_EQ(read_file(folder.path() / "boot.spa"), "as it was");
}

INSTANTIATE_TEST_SUITE_P(Signals, Interrupt, testing::Values(SIGINT, SIGTERM, SIGHUP));

} // namespace
} // namespace spa::test
