// SPDX-License-Identifier: Apache-2.0
// Sources that may not be read, and those that are not there.
#include "assets.h"
#include "batch_folder.h"

#include <sys/stat.h>

namespace spa::test {
namespace {

namespace fs = std::filesystem;

const Surroundings no_superuser{.obeys_permissions = true};

struct Case {
    const char* name;
    const char* locked; // below "in"
    mode_t mode;
    std::vector<const char*> lost;     // the assets that fail
    std::vector<const char*> messages; // of each
};

class Unreadable : public testing::TestWithParam<Case> {};

TEST_P(Unreadable, IsNamedAndTheOthersAreBaked) {
    BatchFolder folder;
    folder.add("good.obj", obj(0));
    folder.add("sub/a.obj", obj(1));
    folder.add("sub/below/b.obj", obj(2));
    folder.add("lit/c.obj", obj(3, "c.mtl"));
    folder.write("lit/c.mtl", mtl_with_picture("c.png"));
    folder.write("lit/c.png", red_png());
    ASSERT_EQ(chmod(folder.in(GetParam().locked).c_str(), GetParam().mode), 0);

    const Outcome outcome = folder.run({"--report", "report.json"}, no_superuser);
    ASSERT_EQ(chmod(folder.in(GetParam().locked).c_str(), 0755), 0);
    EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
    EXPECT_TRUE(folder.maps_are_right());
    EXPECT_TRUE(folder.others().empty());
    const nlohmann::json report = folder.report();
    EXPECT_EQ(report["stopped_by"], nullptr);
    EXPECT_EQ(report["counts"]["failed"], GetParam().lost.size());
    EXPECT_TRUE(fs::exists(folder.map_of("good.obj")));
    for (std::size_t i = 0; i < GetParam().lost.size(); ++i) {
        const nlohmann::json asset = asset_of(report, GetParam().lost[i]);
        ASSERT_EQ(asset["status"], "failed") << GetParam().lost[i];
        EXPECT_EQ(asset["exit_code"], 2);
        EXPECT_EQ(asset["error"], GetParam().messages[i]);
        EXPECT_TRUE(says(outcome.err,
                         std::string(GetParam().lost[i]) + ": failed, exit 2: " + GetParam().messages[i]));
    }
    EXPECT_EQ(folder.run({}, no_superuser).exit_code, 0);
    EXPECT_TRUE(folder.is_complete());
}

const Case cases[] = {
    {"Asset", "sub/a.obj", 0, {"sub/a.obj"}, {"in/sub/a.obj: cannot be read: Permission denied"}},
    {"Library", "lit/c.mtl", 0, {"lit/c.obj"}, {"in/lit/c.mtl: cannot be read: Permission denied"}},
    {"Picture", "lit/c.png", 0, {"lit/c.obj"}, {"in/lit/c.png: cannot be read: Permission denied"}},
    {"Folder", "sub", 0, {"sub/"}, {"in/sub: the folder cannot be read: Permission denied"}},
    {"FolderThatMayBeListed",
     "sub",
     0444,
     {"sub/a.obj", "sub/below/"},
     {"in/sub/a.obj: cannot be read: Permission denied",
      "in/sub/below: the folder cannot be read: Permission denied"}},
};

INSTANTIATE_TEST_SUITE_P(Sources, Unreadable, testing::ValuesIn(cases),
                         [](const testing::TestParamInfo<Case>& given) { return given.param.name; });

// A folder that may hold what is asked for is a failure, and one that may not is none.
TEST(Unreadable, FoldersAndPatterns) {
    BatchFolder folder;
    folder.add("props/a.obj", obj(0));
    folder.add("locked/b.obj", obj(1));
    chmod(folder.in("locked").c_str(), 0);
    for (const char* pattern : {"*.obj", "lock*/b.obj"}) {
        const Outcome outcome = folder.run({"--include", pattern}, no_superuser);
        EXPECT_EQ(outcome.exit_code, 2) << pattern;
        EXPECT_TRUE(says(outcome.err, "locked/: failed, exit 2: in/locked: the folder cannot be read"));
    }
    for (const char* pattern : {"props/**", "/a.obj"})
        EXPECT_EQ(folder.run({"--include", pattern}, no_superuser).exit_code, 0) << pattern;
    for (const char* pattern : {"locked/", "lock*"})
        EXPECT_EQ(folder.run({"--exclude", pattern}, no_superuser).exit_code, 0) << pattern;
    chmod(folder.in("locked").c_str(), 0755);
    EXPECT_EQ(folder.run().exit_code, 0);
    EXPECT_TRUE(folder.is_complete());
}

TEST(Unreadable, FoldersOfTheSameNameInTwoInputs) {
    BatchFolder folder;
    folder.add("1/a.obj", obj(0));
    folder.add("2/b.obj", obj(1));
    for (const char* name : {"1/locked", "2/locked"}) {
        fs::create_directory(folder.in(name));
        chmod(folder.in(name).c_str(), 0);
    }
    const Outcome outcome =
        run_spa({"batch", "in/1", "in/2", "-o", "out", "--size", "16"}, folder.path(), "", no_superuser);
    EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
    for (const char* name : {"in/1/locked", "in/2/locked"})
        EXPECT_TRUE(says(outcome.err, std::string(name) + ": the folder cannot be read: Permission denied"));
    EXPECT_EQ(read_file(folder.out("a.spa")), folder.reference("1/a.obj"));
    EXPECT_EQ(read_file(folder.out("b.spa")), folder.reference("2/b.obj"));
    for (const char* name : {"1/locked", "2/locked"}) chmod(folder.in(name).c_str(), 0755);
}

TEST(Unreadable, WhatTheCommandLineNames) {
    BatchFolder folder;
    folder.add("a.obj", obj(0));
    write_file(folder.path() / "list", "in/a.obj\n");
    write_file(folder.path() / "config.json", "{}");
    for (const char* name : {"list", "config.json", "in"}) chmod((folder.path() / name).c_str(), 0);
    const auto run = [&](std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), {"batch", "-o", "out"});
        return run_spa(arguments, folder.path(), "", no_superuser);
    };
    const Outcome list = run({"@list"});
    EXPECT_EQ(list.exit_code, 2);
    EXPECT_TRUE(says(list.err, "list: the list cannot be opened"));
    const Outcome config = run({"in", "--config", "config.json"});
    EXPECT_EQ(config.exit_code, 2);
    EXPECT_TRUE(says(config.err, "config.json"));
    const Outcome file = run({"in/a.obj"});
    EXPECT_EQ(file.exit_code, 2);
    EXPECT_TRUE(says(file.err, "in/a.obj: cannot be read: Permission denied"));
    const Outcome input = run({"in"});
    EXPECT_EQ(input.exit_code, 2);
    EXPECT_TRUE(says(input.err, "in: the folder cannot be read: Permission denied"));
    EXPECT_TRUE(folder.others().empty());
    chmod(folder.in().c_str(), 0755);
    EXPECT_EQ(folder.run().exit_code, 0);
    EXPECT_TRUE(folder.is_complete());
}

// What is no file is not opened: to open a pipe would be to wait.
TEST(Unreadable, PipesAndFoldersWithTheNamesOfAssets) {
    BatchFolder folder;
    folder.add("good.obj", obj(0));
    ASSERT_EQ(mkfifo(folder.in("pipe.obj").c_str(), 0600), 0);
    fs::create_directory(folder.in("folder.obj"));
    folder.add("folder.obj/inside.obj", obj(1));
    folder.write("lit/a.obj", obj(1, "pipe.mtl"));
    ASSERT_EQ(mkfifo(folder.in("lit/pipe.mtl").c_str(), 0600), 0);
    const Outcome outcome = folder.run();
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_TRUE(says(outcome.err, "pipe.obj: failed, exit 2: in/pipe.obj: not a regular file"));
    EXPECT_TRUE(
        says(outcome.err, "lit/a.obj: failed, exit 2: in/lit/pipe.mtl: cannot be read: not a regular file"));
    EXPECT_TRUE(folder.is_complete());
}

TEST(Unreadable, FilesOfAListThatAreNotThere) {
    BatchFolder folder;
    folder.add("a.obj", obj(0));
    const Outcome outcome =
        run_spa({"batch", "-", "-o", "out", "--size", "16"}, folder.in(), "a.obj\nb.obj\nc/d.obj\n");
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_TRUE(says(outcome.err, "b.obj: failed, exit 2: b.obj: no such file"));
    EXPECT_TRUE(says(outcome.err, "c/d.obj: failed, exit 2: c/d.obj: no such file"));
    EXPECT_EQ(read_file(folder.in("out/a.spa")), folder.reference("a.obj"));
}

} // namespace
} // namespace spa::test
