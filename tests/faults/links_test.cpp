// SPDX-License-Identifier: Apache-2.0
// Symbolic links that lead in circles, nowhere, or out of the folder.
#include "assets.h"
#include "batch_folder.h"

namespace spa::test {
namespace {

namespace fs = std::filesystem;

class Links : public testing::Test {
protected:
    void link(const std::string& target, const std::string& name) const {
        fs::create_directories(folder_.in(name).parent_path());
        fs::create_symlink(target, folder_.in(name));
    }

    BatchFolder folder_;
};

TEST_F(Links, OfFoldersThatLeadInCircles) {
    folder_.add("a.obj", obj(1));
    folder_.add("x/b.obj", obj(2));
    folder_.add("y/c.obj", obj(3));
    link(".", "itself");
    link("..", "x/parent");
    link("../y", "x/to_y");
    link("../x", "y/to_x");
    const Outcome outcome = folder_.run();
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_TRUE(
        says(outcome.err, "spa: warning: 4 symbolic links to folders were not followed; --follow-links"));
    EXPECT_TRUE(folder_.is_complete());

    const Outcome followed = folder_.run({"--follow-links", "--report", "report.json"});
    EXPECT_EQ(followed.exit_code, 0) << followed.err;
    for (const char* circle : {"in/itself", "in/x/parent", "in/x/to_y/to_x", "in/y/to_x/to_y"})
        EXPECT_TRUE(
            says(followed.err, std::string("spa: warning: ") + circle + ": leads back to a folder above it"));
    folder_.add("x/to_y/c.obj", obj(3));
    folder_.add("y/to_x/b.obj", obj(2));
    EXPECT_TRUE(folder_.is_complete());
    EXPECT_EQ(folder_.report()["counts"]["baked"], 2);
    EXPECT_TRUE(says(folder_.run({"--follow-links"}).out, "5 up to date"));
}

// The folder that holds the inputs holds the outputs too: no map is taken for an asset, and all ends.
TEST_F(Links, ToAFolderAbove) {
    folder_.add("a.obj", obj(1));
    link("..", "above");
    for (int i = 0; i < 2; ++i) {
        const Outcome outcome = folder_.run({"--follow-links"});
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        EXPECT_TRUE(says(outcome.err, "in/above/in: leads back to a folder above it"));
        EXPECT_TRUE(folder_.is_complete());
    }
}

TEST_F(Links, OfFiles) {
    write_file(folder_.path() / "outside.obj", obj(4));
    folder_.add("real.obj", obj(1));
    link("real.obj", "inside.obj");
    link("x/../real.obj", "roundabout.obj");
    fs::create_directory(folder_.in("x"));
    link("../outside.obj", "outside.obj");
    link("nowhere.obj", "broken.obj");
    link("loop.obj", "loop.obj");
    link("pong.obj", "ping.obj");
    link("ping.obj", "pong.obj");
    folder_.add("inside.obj", obj(1));
    folder_.add("roundabout.obj", obj(1));
    const auto expect_broken = [&](const Outcome& outcome) {
        EXPECT_EQ(outcome.exit_code, 2);
        EXPECT_TRUE(says(outcome.err, "broken.obj: failed, exit 2: in/broken.obj: no such file"));
        for (const std::string name : {"loop.obj", "ping.obj", "pong.obj"})
            EXPECT_TRUE(says(outcome.err, name + ": failed, exit 2: in/" + name +
                                              ": cannot be read: Too many levels of symbolic links"));
    };
    const Outcome outcome = folder_.run({"--report", "report.json"});
    expect_broken(outcome);
    EXPECT_TRUE(says(outcome.err,
                     "outside.obj: failed, exit 2: in/outside.obj: is a symbolic link that leads out of "
                     "the folder; --follow-links allows it"));
    EXPECT_EQ(folder_.report()["counts"]["failed"], 5);
    EXPECT_TRUE(folder_.is_complete());

    const Outcome followed = folder_.run({"--follow-links", "--report", "report.json"});
    expect_broken(followed);
    EXPECT_EQ(folder_.report()["counts"]["failed"], 4);
    EXPECT_EQ(folder_.report()["counts"]["baked"], 1);
    folder_.add("outside.obj", obj(4)); // writes through the link what is there
    EXPECT_TRUE(folder_.is_complete());
}

// An asset is not to make its picture of what it does not own, such as a key of whoever runs the batch.
TEST_F(Links, OfFilesThatAreReferredTo) {
    write_file(folder_.path() / "secret.png", red_png());
    folder_.add("in/a.obj", obj(1, "a.mtl"));
    folder_.write("in/a.mtl", mtl_with_picture("sub/a.png"));
    folder_.write("in/real.png", blue_png());
    link("../real.png", "in/sub/a.png");
    folder_.add("out/b.obj", obj(1, "b.mtl"));
    folder_.write("out/b.mtl", mtl_with_picture("b.png"));
    link("../../secret.png", "out/b.png");
    folder_.add("lib/c.obj", obj(1, "c.mtl"));
    link("../../c.mtl", "lib/c.mtl");
    write_file(folder_.path() / "c.mtl", mtl_with_shade(3));
    folder_.add("broken/d.obj", obj(1, "d.mtl"));
    link("nowhere", "broken/d.mtl");
    const Outcome outcome = folder_.run({"--report", "report.json"});
    EXPECT_EQ(outcome.exit_code, 3) << outcome.err;
    EXPECT_TRUE(says(outcome.err, "out/b.obj: failed, exit 3: in/out/b.obj: "));
    EXPECT_TRUE(says(outcome.err, "lib/c.obj: failed, exit 3: in/lib/c.obj: "));
    EXPECT_TRUE(says(outcome.err, "is a symbolic link to another place, which only --follow-links allows"));
    EXPECT_EQ(folder_.report()["counts"]["baked"], 2);
    EXPECT_FALSE(fs::exists(folder_.map_of("out/b.obj")));
    EXPECT_FALSE(fs::exists(folder_.map_of("lib/c.obj")));

    const Outcome followed = folder_.run({"--follow-links"});
    EXPECT_EQ(followed.exit_code, 0) << followed.err;
    EXPECT_TRUE(says(followed.out, "2 baked, 2 up to date"));
    EXPECT_TRUE(says(folder_.run({"--follow-links"}).out, "4 up to date"));
    // What a link leads to is a source as any other.
    write_file(folder_.path() / "secret.png", blue_png());
    EXPECT_TRUE(says(folder_.run({"--follow-links"}).out, "1 baked"));
    for (const std::string& name : folder_.assets()) EXPECT_TRUE(is_whole(folder_.map_of(name)));
}

} // namespace
} // namespace spa::test
