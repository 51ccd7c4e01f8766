// SPDX-License-Identifier: Apache-2.0
#include "process.h"

#include "../../tools/verb.h"

#include <gtest/gtest.h>

namespace spa::test {
namespace {

TEST(Help, WithoutArgumentsPrintsUsageOnStderr) {
    const TemporaryFolder folder;
    const Outcome outcome = run_spa({}, folder.path());
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_EQ(outcome.out, "");
    EXPECT_NE(outcome.err.find("SYNOPSIS"), std::string::npos);
}

TEST(Help, OverviewListsEveryVerb) {
    const TemporaryFolder folder;
    const Outcome outcome = run_spa({"help"}, folder.path());
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_EQ(outcome.err, "");
    for (const tools::Verb& verb : tools::verbs()) {
        EXPECT_NE(outcome.out.find(verb.name), std::string::npos) << verb.name;
        EXPECT_NE(outcome.out.find(verb.summary), std::string::npos) << verb.name;
    }
    EXPECT_EQ(run_spa({"--help"}, folder.path()).out, outcome.out);
}

TEST(Help, EveryVerbHasAManualPage) {
    const TemporaryFolder folder;
    for (const tools::Verb& verb : tools::verbs()) {
        const Outcome outcome = run_spa({"help", verb.name}, folder.path());
        EXPECT_EQ(outcome.exit_code, 0) << verb.name;
        for (const char* section : {"NAME\n", "\nSYNOPSIS\n", "\nDESCRIPTION\n", "\nOPTIONS\n",
                                    "\nEXAMPLES\n", "\nEXIT STATUS\n", "\nSEE ALSO\n"})
            EXPECT_NE(outcome.out.find(section), std::string::npos) << verb.name << section;
        EXPECT_EQ(run_spa({verb.name, "--help"}, folder.path()).out, outcome.out) << verb.name;
    }
}

TEST(Help, BakePageListsItsOptionsButNotTheHiddenOne) {
    const TemporaryFolder folder;
    const std::string page = run_spa({"help", "bake"}, folder.path()).out;
    for (const char* option :
         {"--mapping octahedral|latlong", "--size N|WxH", "--color-size", "--depth u8|u16|f32",
          "--normals oct8|oct16|rgb8", "--layers", "--frame auto|sphere|affine",
          "--center auto|bounds|captured", "--baker radial|orbit", "--gl auto|egl|osmesa", "--samples",
          "--paper", "--threads", "--compress zstd|none", "--format text|json", "--quiet"})
        EXPECT_NE(page.find(option), std::string::npos) << option;
    EXPECT_EQ(page.find("--gl-naive"), std::string::npos);
}

TEST(Help, NoLineIsWiderThanATerminal) {
    for (const tools::Verb& verb : tools::verbs()) {
        const std::string page = tools::manual_page(verb);
        for (std::size_t start = 0; start < page.size();) {
            const std::size_t end = page.find('\n', start);
            EXPECT_LE(end - start, 80U) << page.substr(start, end - start);
            start = end + 1;
        }
    }
}

TEST(Help, VersionIsOnStdout) {
    const TemporaryFolder folder;
    const Outcome outcome = run_spa({"--version"}, folder.path());
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_EQ(outcome.out, "spa " SPA_VERSION "\n");
}

} // namespace
} // namespace spa::test
