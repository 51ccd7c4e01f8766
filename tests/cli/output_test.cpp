// SPDX-License-Identifier: Apache-2.0
// Outputs appear whole or not at all, and what cannot be written is said before any work.
#include "../../tools/output.h"
#include "process.h"

#include "../../libspa/core/error.h"

#include <gtest/gtest.h>

#include <sys/stat.h>

namespace spa::test {
namespace {

std::span<const std::byte> bytes_of(const std::string& text) { return std::as_bytes(std::span(text)); }

ExitCode code_of(const std::function<void()>& call) {
    try {
        call();
    } catch (const Error& error) {
        return error.code();
    }
    return ExitCode::ok;
}

TEST(Output, MissingFolderIsSaidBeforeTheInputIsRead) {
    const TemporaryFolder folder;
    const Outcome outcome = run_spa({"bake", "missing.glb", "-o", "nowhere/out.spa"}, folder.path());
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_NE(outcome.err.find("nowhere: no such folder"), std::string::npos) << outcome.err;
}

TEST(Output, FolderAsOutputFileIsRefused) {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder.path() / "sub");
    for (const char* output : {"sub", "sub/", "."}) {
        const Outcome outcome = run_spa({"sample", "cube", "-o", output}, folder.path());
        EXPECT_EQ(outcome.exit_code, 2) << output << outcome.err;
        EXPECT_NE(outcome.err.find("folder"), std::string::npos) << outcome.err;
    }
    EXPECT_EQ(folder.names(), std::vector<std::string>{"sub"});
}

TEST(Output, DeviceIsNotReplacedByAFile) {
    const TemporaryFolder folder;
    const Outcome outcome = run_spa({"sample", "cube", "-o", "/dev/null"}, folder.path());
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_NE(outcome.err.find("not a regular file"), std::string::npos) << outcome.err;
}

TEST(Output, FolderWithoutWritePermissionIsRefused) {
    if (geteuid() == 0) GTEST_SKIP() << "the superuser may write anywhere";
    const TemporaryFolder folder;
    chmod(folder.path().c_str(), 0555);
    EXPECT_EQ(code_of([&] { tools::check_output_file(folder.path() / "a"); }), ExitCode::input_output);
    chmod(folder.path().c_str(), 0755);
}

TEST(Output, InputIsFoundUnderAnotherName) {
    const TemporaryFolder folder;
    write_file(folder.path() / "in", "x");
    std::filesystem::create_hard_link(folder.path() / "in", folder.path() / "same");
    const std::filesystem::path inputs[] = {folder.path() / "in"};
    EXPECT_EQ(code_of([&] { tools::check_output_file(folder.path() / "same", inputs); }), ExitCode::usage);
    EXPECT_EQ(code_of([&] { tools::check_output_file(folder.path() / "other", inputs); }), ExitCode::ok);
}

TEST(Output, StagedFileReplacesOnCommitOnly) {
    const TemporaryFolder folder;
    const std::filesystem::path path = folder.path() / "file";
    write_file(path, "old");
    {
        tools::StagedFile staged(path);
        staged.write(bytes_of("lost"));
        EXPECT_EQ(read_file(path), "old");
    }
    EXPECT_EQ(read_file(path), "old");
    EXPECT_EQ(folder.names(), std::vector<std::string>{"file"});
    {
        tools::StagedFile staged(path);
        staged.write(bytes_of("new"));
        staged.commit();
    }
    EXPECT_EQ(read_file(path), "new");
    EXPECT_EQ(folder.names(), std::vector<std::string>{"file"});
}

TEST(Output, StagedFileHasThePermissionsOfAnyNewFile) {
    const TemporaryFolder folder;
    const mode_t mask = umask(027);
    tools::StagedFile staged(folder.path() / "file");
    staged.commit();
    umask(mask);
    struct stat status {};
    ASSERT_EQ(stat((folder.path() / "file").c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 0777U, 0640U);
}

TEST(Output, StagedFolderAppearsWhole) {
    const TemporaryFolder folder;
    {
        tools::StagedFolder staged(folder.path() / "new");
        staged.write("a", bytes_of("1"));
    }
    EXPECT_TRUE(folder.names().empty());
    {
        tools::StagedFolder staged(folder.path() / "new/");
        staged.write("a", bytes_of("1"));
        EXPECT_FALSE(std::filesystem::exists(folder.path() / "new"));
        staged.commit();
    }
    EXPECT_EQ(folder.names(), (std::vector<std::string>{"new", "new/a"}));
}

TEST(Output, StagedFolderThatExistsKeepsItsOtherFiles) {
    const TemporaryFolder folder;
    write_file(folder.path() / "a", "old");
    write_file(folder.path() / "b", "kept");
    {
        tools::StagedFolder staged(folder.path());
        staged.write("a", bytes_of("new"));
        EXPECT_EQ(read_file(folder.path() / "a"), "old");
        staged.commit();
    }
    EXPECT_EQ(folder.names(), (std::vector<std::string>{"a", "b"}));
    EXPECT_EQ(read_file(folder.path() / "a"), "new");
    EXPECT_EQ(read_file(folder.path() / "b"), "kept");
}

} // namespace
} // namespace spa::test
