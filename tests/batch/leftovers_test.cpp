// SPDX-License-Identifier: Apache-2.0
#include "../../tools/output.h"
#include "../cli/process.h"

#include <gtest/gtest.h>

namespace spa::test {
namespace {

using Names = std::vector<std::string>;

TEST(Leftovers, OnlyThoseOfDeadProcessesAndOfThisNameAreRemoved) {
    const TemporaryFolder folder;
    for (const char* name : {".a.spa.x1Y2z3", ".b.spa.x1Y2z3", ".a.spa", "a.spa.x1Y2z3", ".a.spa.x1Y2z34"})
        write_file(folder.path() / name, "half");
    const tools::StagedFile alive(folder.path() / "a.spa");
    tools::remove_leftovers(folder.path(), [](const std::string& name) { return name == "a.spa"; });
    Names left{".a.spa", ".a.spa.x1Y2z34", ".b.spa.x1Y2z3", alive.temporary_path().filename().string(),
               "a.spa.x1Y2z3"};
    std::sort(left.begin(), left.end());
    EXPECT_EQ(folder.names(), left);
}

TEST(Leftovers, LongNamesAreFoundAsTheyAreCut) {
    const TemporaryFolder folder;
    const std::string name = std::string(251, 'n') + ".spa";
    std::string temporary;
    {
        tools::StagedFile file(folder.path() / name);
        temporary = file.temporary_path().filename().string();
    }
    EXPECT_EQ(folder.names(), Names{});
    write_file(folder.path() / temporary, "half");
    tools::remove_leftovers(folder.path(),
                            [&](const std::string& staged) { return staged == tools::staged_name(name); });
    EXPECT_EQ(folder.names(), Names{});
}

TEST(Leftovers, AMissingFolderIsNoMatter) {
    tools::remove_leftovers("/none/of/this", [](const std::string&) { return true; });
}

} // namespace
} // namespace spa::test
