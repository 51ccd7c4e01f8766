// SPDX-License-Identifier: Apache-2.0
// Sources that change, vanish and come back, while a batch runs and between two.
#include "assets.h"
#include "batch_folder.h"
#include "sanitizer.h"

#include <atomic>
#include <chrono>
#include <ctime>
#include <fcntl.h>
#include <functional>
#include <random>
#include <sys/stat.h>
#include <sys/xattr.h>
#include <thread>
#include <unistd.h>

namespace spa::test {
namespace {

namespace fs = std::filesystem;

// Rewrites assets until it is destroyed.
class Vandal {
public:
    explicit Vandal(const BatchFolder& folder) : folder_(folder), thread_([this] { work(); }) {}
    ~Vandal() {
        done_ = true;
        thread_.join();
    }
    Vandal(const Vandal&) = delete;
    Vandal& operator=(const Vandal&) = delete;

private:
    void work() {
        const std::vector<std::string> names(folder_.assets().begin(), folder_.assets().end());
        std::mt19937 random(7);
        while (!done_) {
            std::this_thread::sleep_for(std::chrono::microseconds(100)); // the batch wants to run, too
            const fs::path asset = folder_.in(names[random() % names.size()]);
            const std::string text = obj(int(1 + random() % 2));
            switch (random() % 3) {
            case 0: // renamed over
                write_file(folder_.path() / "new", text);
                fs::rename(folder_.path() / "new", asset);
                break;
            case 1: // written in place
                if (const int file = open(asset.c_str(), O_WRONLY | O_CLOEXEC); file >= 0) {
                    EXPECT_EQ(pwrite(file, text.data(), text.size(), 0), ssize_t(text.size()));
                    close(file);
                }
                break;
            default: // gone, and back
                fs::remove(asset);
                std::this_thread::yield();
                write_file(asset, text);
            }
        }
    }

    const BatchFolder& folder_;
    std::atomic<bool> done_ = false;
    std::thread thread_;
};

TEST(Changing, DuringTheRunEveryMapIsOfOneContent) {
    BatchFolder folder;
    std::map<std::string, std::set<std::string>> right; // by name
    for (int i = 0; i < 12; ++i) {
        const std::string name = std::to_string(i / 3) + "/" + "abc"[i % 3] + ".obj";
        for (const int shape : {1, 2}) {
            folder.add(name, obj(shape));
            right[name].insert(folder.reference(name));
        }
    }
    std::size_t baked = 0;
    {
        const Vandal vandal(folder);
        for (int round = 0; round < rounds(6); ++round) {
            SCOPED_TRACE(round);
            const Outcome outcome = folder.run({"--report", "report.json"});
            const nlohmann::json report = folder.report();
            baked += report["counts"]["baked"].get<std::size_t>();
            for (const nlohmann::json& asset : report["assets"]) {
                const std::string name = asset["source"];
                if (asset["status"] == "failed") {
                    EXPECT_TRUE(asset["exit_code"] == 2 || asset["exit_code"] == 3) << asset.dump(1);
                    EXPECT_TRUE(says(asset["error"], "in/" + name));
                    EXPECT_TRUE(says(outcome.err, name + ": failed"));
                }
                if (!fs::exists(folder.map_of(name))) continue;
                EXPECT_TRUE(is_whole(folder.map_of(name)));
                EXPECT_TRUE(right[name].contains(read_file(folder.map_of(name)))) << name;
            }
            EXPECT_EQ(report["counts"]["failed"] == 0, outcome.exit_code == 0);
            EXPECT_TRUE(folder.others().empty());
        }
    }
    EXPECT_GT(baked, 0U);
    EXPECT_EQ(folder.run().exit_code, 0);
    EXPECT_TRUE(folder.is_complete());
}

// Between two runs: what is done to the sources of one asset, and whether that is a reason to bake.
class ChangedBetween : public testing::Test {
protected:
    ChangedBetween() {
        folder_.add("plain/a.obj", obj(1));
        folder_.add("lit/b.obj", obj(1, "b.mtl"));
        folder_.write("lit/b.mtl", mtl_with_picture("b.png"));
        folder_.write("lit/b.png", red_png());
        folder_.add("lacking/c.obj", obj(1, "c.mtl"));
        folder_.write("lacking/c.mtl", mtl_with_picture("c.png"));
        folder_.add("alone/d.obj", obj(1, "d.mtl"));
    }

    void bake() {
        const Outcome outcome = folder_.run();
        ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
        ASSERT_TRUE(folder_.is_complete());
    }

    // Waits before that until the sources are so old that their states are remembered in the maps.
    void bake_old() {
        const auto old = std::chrono::system_clock::now() + std::chrono::milliseconds(2100);
        while (std::chrono::system_clock::now() < old) usleep(10'000);
        bake();
        std::array<char, 64> value{};
        if (getxattr(folder_.map_of("lit/b.obj").c_str(), "user.spa.sources", value.data(), value.size()) > 0)
            return;
        EXPECT_EQ(errno, ENOTSUP);
        std::printf("this file system has no extended attributes: states are not tried\n");
    }

    // Runs a batch and expects this asset, and no other, to be baked because of its sources.
    void expect_baked(const std::string& name) {
        SCOPED_TRACE(name);
        expect_counts(1);
        EXPECT_EQ(asset_of(folder_.report(), name)["reason"], "sources");
    }
    void expect_none_baked() { expect_counts(0); }

    [[nodiscard]] struct stat state(const std::string& name) const {
        struct stat status {};
        EXPECT_EQ(stat(folder_.in(name).c_str(), &status), 0);
        return status;
    }
    void set_time(const std::string& name, std::timespec time) const {
        const std::array<std::timespec, 2> times{time, time};
        ASSERT_EQ(utimensat(AT_FDCWD, folder_.in(name).c_str(), times.data(), 0), 0);
    }

    BatchFolder folder_;

private:
    void expect_counts(int baked) {
        const Outcome outcome = folder_.run({"--report", "report.json"});
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        EXPECT_EQ(folder_.report()["counts"]["baked"], baked) << outcome.err;
        EXPECT_TRUE(folder_.is_complete());
        EXPECT_TRUE(says(folder_.run().out, " 0 baked"));
    }
};

TEST_F(ChangedBetween, ContentOfTheSameSizeWithItsTimeSetBack) {
    bake_old();
    const std::timespec time = state("plain/a.obj").st_mtim;
    folder_.write("plain/a.obj", obj(2));
    set_time("plain/a.obj", time);
    expect_baked("plain/a.obj");
    bake();
    // Another file under its name.
    write_file(folder_.path() / "new", obj(3));
    fs::rename(folder_.path() / "new", folder_.in("plain/a.obj"));
    set_time("plain/a.obj", time);
    expect_baked("plain/a.obj");
}

TEST_F(ChangedBetween, TimesAloneAreNoReason) {
    bake_old();
    for (const std::time_t seconds :
         {std::time(nullptr) + 86'400, std::time_t(86'400), std::time_t(-86'400)}) {
        set_time("plain/a.obj", {seconds, 5});
        set_time("lit/b.png", {seconds, 5});
        expect_none_baked();
    }
    write_file(folder_.path() / "same", obj(1));
    fs::rename(folder_.path() / "same", folder_.in("plain/a.obj"));
    expect_none_baked();
}

// As after a clock that was set back or forth, or in an archive from another time zone.
TEST_F(ChangedBetween, FilesFromTheFutureAndFromLongAgo) {
    int shape = 2;
    for (const std::time_t seconds : {std::time(nullptr) + 86'400, std::time_t(86'400)}) {
        set_time("plain/a.obj", {seconds, 0});
        bake_old();
        folder_.write("plain/a.obj", obj(shape++));
        set_time("plain/a.obj", {seconds, 0});
        expect_baked("plain/a.obj");
    }
}

TEST_F(ChangedBetween, FilesThatAnAssetRefersTo) {
    bake_old();
    const std::timespec time = state("lit/b.png").st_mtim;
    ASSERT_EQ(red_png().size(), blue_png().size());
    folder_.write("lit/b.png", blue_png());
    set_time("lit/b.png", time);
    expect_baked("lit/b.obj");
    folder_.write("lit/b.mtl", mtl_with_shade(3));
    expect_baked("lit/b.obj");
    folder_.write("lit/b.mtl", mtl_with_shade(4)); // of the same size
    expect_baked("lit/b.obj");
    fs::remove(folder_.in("lit/b.png")); // no longer referred to
    expect_none_baked();
}

TEST_F(ChangedBetween, FilesThatWereMissingAppear) {
    bake();
    folder_.write("lacking/c.png", blue_png());
    expect_baked("lacking/c.obj");
    folder_.write("alone/d.mtl", mtl_with_shade(5));
    expect_baked("alone/d.obj");
    fs::remove(folder_.in("lacking/c.png"));
    expect_baked("lacking/c.obj");
    fs::remove(folder_.in("alone/d.mtl"));
    expect_baked("alone/d.obj");
}

// A name in an OBJ file means a file whose letters differ in case, if there is none of the name itself.
TEST_F(ChangedBetween, FilesWhoseNamesDifferInCase) {
    bake();
    folder_.write("lacking/C.PNG", blue_png());
    expect_baked("lacking/c.obj");
    folder_.write("lacking/c.png", red_png());
    expect_baked("lacking/c.obj");
    folder_.write("alone/D.mtl", mtl_with_shade(5));
    expect_baked("alone/d.obj");
    folder_.write("alone/d.mtl", mtl_with_shade(6));
    expect_baked("alone/d.obj");
}

// What is in a folder of maps need not be what was written there.
TEST_F(ChangedBetween, MapsThatAreDamagedAreBakedAgain) {
    bake();
    const std::string map = read_file(folder_.map_of("plain/a.obj"));
    for (const std::string& bytes : {std::string(), std::string("no map"), map.substr(0, 200), map}) {
        write_file(folder_.map_of("plain/a.obj"), bytes);
        if (bytes == map) chmod(folder_.map_of("plain/a.obj").c_str(), 0); // right, but it cannot be told
        const Outcome outcome = folder_.run({}, {.obeys_permissions = true});
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        EXPECT_TRUE(says(outcome.err, "plain/a.obj: baked (damaged)"));
        EXPECT_TRUE(folder_.is_complete());
    }
}

// Somebody cuts and restores maps in place while they are looked at.
TEST(Changing, MapsDuringTheRun) {
    BatchFolder folder({"--size", "64", "--compress", "none"});
    for (int i = 0; i < 40; ++i) folder.add(std::to_string(i) + "/a.obj", obj(1));
    ASSERT_EQ(folder.run().exit_code, 0);
    std::atomic<bool> done = false;
    std::thread cutter([&] {
        std::mt19937 random(3);
        while (!done) {
            std::this_thread::sleep_for(std::chrono::microseconds(100));
            const fs::path map = folder.map_of(std::to_string(random() % 40) + "/a.obj");
            if (truncate(map.c_str(), off_t(random() % 5000)) != 0) ADD_FAILURE() << "no such map";
        }
    });
    for (int round = 0; round < 3; ++round) {
        const Outcome outcome = folder.run();
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err << outcome.signal;
    }
    done = true;
    cutter.join();
    EXPECT_EQ(folder.run().exit_code, 0);
    for (const std::string& name : folder.assets())
        if (!is_whole(folder.map_of(name))) fs::remove(folder.map_of(name)); // what the front does not show
    EXPECT_EQ(folder.run().exit_code, 0);
    EXPECT_TRUE(folder.is_complete());
}

} // namespace
} // namespace spa::test
