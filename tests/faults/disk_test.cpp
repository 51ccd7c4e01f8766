// SPDX-License-Identifier: Apache-2.0
// Outputs that cannot be written: a full disk, a read-only one, folders without permission, names that are
// taken.
#include "assets.h"
#include "batch_folder.h"
#include "small_disk.h"

#include <csignal>
#include <sys/stat.h>
#include <unistd.h>

namespace spa::test {
namespace {

namespace fs = std::filesystem;

constexpr const char* no_mounts = "this process may not mount a file system";

void add_assets(BatchFolder& folder, int count) {
    for (int i = 0; i < count; ++i)
        folder.add(std::to_string(i / 5) + "/" + "abcde"[i % 5] + ".obj", obj(i % 5));
}

// Runs out in the middle of a file, or while a file or a folder is made.
class DiskFull : public testing::TestWithParam<const char*> {};

TEST_P(DiskFull, StopsAndTheNextRunGoesOn) {
    BatchFolder folder({"--size", "32", "--compress", "none"});
    add_assets(folder, 20);
    const std::unique_ptr<SmallDisk> disk = SmallDisk::mount_on(folder.out(), GetParam());
    if (!disk) GTEST_SKIP() << no_mounts;

    const Outcome full = folder.run({"--report", "report.json"});
    EXPECT_EQ(full.exit_code, 2);
    EXPECT_TRUE(says(full.err, "No space left on device"));
    EXPECT_TRUE(says(full.err, "stopped, as outputs cannot be written"));
    EXPECT_TRUE(folder.maps_are_right());
    EXPECT_TRUE(folder.others().empty());
    const nlohmann::json report = folder.report();
    EXPECT_EQ(report["stopped_by"], "output");
    EXPECT_GT(report["counts"]["baked"], 0);
    EXPECT_GT(report["counts"]["not_started"], 0);
    for (const nlohmann::json& asset : report["assets"]) {
        if (asset["status"] != "failed") continue;
        EXPECT_EQ(asset["exit_code"], 2);
        EXPECT_TRUE(says(asset["error"], "out/" + asset["source"].get<std::string>().substr(0, 1)));
    }

    const Outcome all_tried = folder.run({"--keep-going", "--report", "report.json"});
    EXPECT_EQ(all_tried.exit_code, 2);
    EXPECT_TRUE(folder.maps_are_right());
    EXPECT_TRUE(folder.others().empty());
    EXPECT_EQ(folder.report()["stopped_by"], nullptr);
    EXPECT_EQ(folder.report()["counts"]["not_started"], 0);
    EXPECT_EQ(folder.report()["counts"]["baked"], 0);

    ASSERT_TRUE(disk->change("size=4m,nr_inodes=1000"));
    EXPECT_EQ(folder.run().exit_code, 0);
    EXPECT_TRUE(folder.is_complete());
}

INSTANTIATE_TEST_SUITE_P(Disks, DiskFull, testing::Values("size=256k", "nr_inodes=9"),
                         [](const testing::TestParamInfo<const char*>& disk) {
                             return disk.index == 0 ? "Bytes" : "Inodes";
                         });

TEST(Disk, ReportThatDoesNotFitIsSaidAndTheOthersAreWritten) {
    BatchFolder folder;
    add_assets(folder, 3);
    const std::unique_ptr<SmallDisk> disk = SmallDisk::mount_on(folder.path() / "disk", "size=4k");
    if (!disk) GTEST_SKIP() << no_mounts;
    write_file(folder.path() / "disk/full", std::string(4096, 'x'));
    const Outcome outcome = folder.run({"--report", "disk/report.json", "--report", "report.json"});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_TRUE(says(outcome.err, "disk/report.json: cannot be written: No space left on device"));
    EXPECT_TRUE(says(outcome.out, "3 assets: 3 baked"));
    EXPECT_EQ(folder.report()["counts"]["baked"], 3);
    EXPECT_TRUE(folder.is_complete());
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path() / "disk"), {}), 1);
}

TEST(Disk, ReadOnlyIsSaidBeforeAnyWork) {
    BatchFolder folder;
    add_assets(folder, 3);
    const std::unique_ptr<SmallDisk> disk = SmallDisk::mount_on(folder.out(), "size=1m");
    if (!disk) GTEST_SKIP() << no_mounts;
    ASSERT_TRUE(disk->change("size=1m", true));
    const Outcome outcome = folder.run();
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(outcome.err, "spa: out: the folder may not be written to: Read-only file system\n");
    ASSERT_TRUE(disk->change("size=1m"));
    EXPECT_TRUE(fs::is_empty(folder.out()));
    EXPECT_EQ(folder.run().exit_code, 0);
    EXPECT_TRUE(folder.is_complete());
}

TEST(Disk, ThatBecomesReadOnlyStopsTheBatch) {
    BatchFolder folder;
    add_assets(folder, 60);
    const std::unique_ptr<SmallDisk> disk = SmallDisk::mount_on(folder.out(), "size=1m");
    if (!disk) GTEST_SKIP() << no_mounts;
    Process process(folder.batch({"--report", "report.json"}), folder.path());
    ASSERT_TRUE(
        process.until([&] { return fs::exists(folder.out("0/a.spa")) && disk->change("size=1m", true); }));
    const Outcome outcome = process.wait();
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_TRUE(says(outcome.err, "Read-only file system"));
    EXPECT_TRUE(folder.maps_are_right());
    EXPECT_EQ(folder.report()["stopped_by"], "output");
    EXPECT_GT(folder.report()["counts"]["not_started"], 0);
    ASSERT_TRUE(disk->change("size=1m"));
    EXPECT_EQ(folder.run().exit_code, 0);
    EXPECT_TRUE(folder.is_complete());
}

const Surroundings no_superuser{.obeys_permissions = true};

TEST(Permissions, OutputFolderThatMayNotBeWrittenTo) {
    BatchFolder folder;
    add_assets(folder, 3);
    fs::create_directory(folder.out());
    chmod(folder.out().c_str(), 0555);
    const Outcome outcome = folder.run({}, no_superuser);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(outcome.err, "spa: out: the folder may not be written to: Permission denied\n");
    EXPECT_TRUE(fs::is_empty(folder.out()));
    chmod(folder.out().c_str(), 0755);
    EXPECT_EQ(folder.run({}, no_superuser).exit_code, 0);
    EXPECT_TRUE(folder.is_complete());
}

TEST(Permissions, FolderBelowItThatMayNotBeWrittenToCostsItsAssetsAlone) {
    BatchFolder folder;
    add_assets(folder, 15);
    fs::create_directories(folder.out("1"));
    chmod(folder.out("1").c_str(), 0555);
    const Outcome outcome = folder.run({"--report", "report.json"}, no_superuser);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_TRUE(says(outcome.err,
                     "1/a.obj: failed, exit 2: out/1: the folder may not be written to: Permission denied"));
    EXPECT_EQ(folder.report()["stopped_by"], nullptr);
    EXPECT_EQ(folder.report()["counts"]["failed"], 5);
    EXPECT_EQ(folder.report()["counts"]["baked"], 10);
    EXPECT_TRUE(folder.maps_are_right());
    chmod(folder.out("1").c_str(), 0755);
    EXPECT_EQ(folder.run({}, no_superuser).exit_code, 0);
    EXPECT_TRUE(folder.is_complete());
}

TEST(Permissions, FolderThatLosesItsPermissionsDuringTheRun) {
    BatchFolder folder;
    add_assets(folder, 40);
    Process process(folder.batch({"--report", "report.json"}), folder.path(), "", no_superuser);
    ASSERT_TRUE(process.until([&] { return fs::exists(folder.out("0/a.spa")); }));
    chmod(folder.out().c_str(), 0555);
    const Outcome outcome = process.wait();
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_TRUE(says(outcome.err, "Permission denied"));
    EXPECT_TRUE(folder.maps_are_right());
    EXPECT_TRUE(folder.others().empty());
    chmod(folder.out().c_str(), 0755);
    EXPECT_EQ(folder.run({}, no_superuser).exit_code, 0);
    EXPECT_TRUE(folder.is_complete());
}

TEST(Disk, OutputFolderThatVanishesAgainAndAgain) {
    BatchFolder folder;
    add_assets(folder, 40);
    Process process(folder.batch({"--report", "report.json"}), folder.path());
    std::error_code ignored;
    int removed = 0;
    while (process.until([&] { return fs::exists(folder.out("0")) || fs::exists(folder.out("1")); })) {
        fs::remove_all(folder.out(), ignored);
        ++removed;
    }
    const Outcome outcome = process.wait();
    EXPECT_GT(removed, 1);
    EXPECT_TRUE(outcome.exit_code == 0 || outcome.exit_code == 2) << outcome.err;
    EXPECT_TRUE(folder.maps_are_right());
    EXPECT_EQ(folder.report()["counts"]["not_started"], 0);
    const nlohmann::json report = folder.report();
    for (const nlohmann::json& asset : report["assets"])
        EXPECT_TRUE(asset["status"] == "baked" || says(asset["error"], "out/")) << asset;
    EXPECT_EQ(folder.run().exit_code, 0);
    EXPECT_TRUE(folder.is_complete());
}

// A pipe must not be waited for, and what is no regular file not be replaced.
TEST(Disk, PlaceOfAMapThatIsTaken) {
    BatchFolder folder;
    for (const char* name : {"folder.obj", "good.obj", "pipe.obj"}) folder.add(name, obj(1));
    fs::create_directories(folder.out("folder.spa/inside"));
    ASSERT_EQ(mkfifo(folder.out("pipe.spa").c_str(), 0600), 0);
    const Outcome outcome = folder.run();
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_TRUE(says(outcome.err, "folder.obj: failed, exit 2: out/folder.spa: is a folder"));
    EXPECT_TRUE(says(outcome.err, "pipe.obj: failed, exit 2: out/pipe.spa: is not a regular file"));
    EXPECT_EQ(read_file(folder.out("good.spa")), folder.reference("good.obj"));
    EXPECT_TRUE(fs::is_directory(folder.out("folder.spa/inside")));
    EXPECT_TRUE(fs::is_fifo(folder.out("pipe.spa")));
    fs::remove_all(folder.out("folder.spa"));
    fs::remove(folder.out("pipe.spa"));
    EXPECT_EQ(folder.run().exit_code, 0);
    EXPECT_TRUE(folder.is_complete());
}

// A map that is a link is replaced; what it leads to is nobody's map.
TEST(Disk, LinkInPlaceOfAMapIsReplaced) {
    BatchFolder folder;
    for (const char* name : {"broken.obj", "elsewhere.obj", "loop.obj"}) folder.add(name, obj(1));
    fs::create_directory(folder.out());
    write_file(folder.path() / "precious", "as it was");
    fs::create_symlink("nowhere", folder.out("broken.spa"));
    fs::create_symlink("../precious", folder.out("elsewhere.spa"));
    fs::create_symlink("loop.spa", folder.out("loop.spa"));
    const Outcome outcome = folder.run();
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(read_file(folder.path() / "precious"), "as it was");
    EXPECT_FALSE(fs::is_symlink(folder.out("elsewhere.spa")));
    EXPECT_TRUE(folder.is_complete());
}

} // namespace
} // namespace spa::test
