// SPDX-License-Identifier: Apache-2.0
// A map is judged against an OBJ with a material library, of which a texture is missing at first.
#include "../../tools/up_to_date.h"

#include "../../formats/container/reader.h"
#include "../../formats/container/writer.h"
#include "../cli/process.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/xattr.h>

namespace spa::test {
namespace {

namespace fs = std::filesystem;
using tools::BakeReason;
using tools::BakeSettings;
using tools::Freshness;
using tools::MapState;

constexpr const char* object = "mtllib m.mtl\nusemtl red\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
                               "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";
constexpr std::uint64_t anything = UINT64_MAX;
constexpr std::uint64_t nothing = 0;

class UpToDate : public testing::Test {
protected:
    void SetUp() override {
        write_file(asset(), object);
        write_file(library(), "newmtl red\nKd 1 0 0\nmap_Kd t.png\n");
        age();
        bake();
        ASSERT_EQ(judge().freshness, Freshness::current);
    }
    void bake(const std::vector<std::string>& options = {}) {
        std::vector<std::string> arguments{"bake", "a.obj", "-o", "a.spa", "--size", "8", "-q"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        const Outcome outcome = run_spa(arguments, folder_.path());
        ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    }
    // As if the sources were an hour old: their times can be trusted. (That of the inode cannot be set; where
    // it is too young nothing is remembered, which these tests then work around.)
    void age() const {
        for (const fs::path& path : {asset(), library()})
            fs::last_write_time(path, fs::file_time_type::clock::now() - std::chrono::hours(1));
    }
    [[nodiscard]] MapState judge(std::uint64_t read_at_most = anything) const {
        BakeSettings settings;
        settings.options.grid = settings.options.color_grid = {Mapping::octahedral, 9, 9};
        return tools::judge_map(map(), asset(), settings, read_at_most);
    }
    [[nodiscard]] BakeReason reason() const {
        const MapState state = judge();
        EXPECT_EQ(state.freshness == Freshness::stale, state.reason != BakeReason::none);
        return state.reason;
    }
    // The attribute that a run makes once the sources are old enough, made at once.
    void remember() const {
        import::Report report;
        for (const fs::path& path : {asset(), library()})
            report.files.push_back({path.filename().string(), 0, 0, *import::file_state(path)});
        const auto metadata = nlohmann::json::parse(read_metadata());
        std::timespec later{};
        clock_gettime(CLOCK_REALTIME, &later);
        later.tv_sec += 3600;
        tools::remember_sources(map(), report, metadata["key"], later);
    }
    [[nodiscard]] std::string read_metadata() const {
        std::string metadata;
        EXPECT_TRUE(container::read_metadata(map().string(), metadata).ok());
        return metadata;
    }
    // The map with other metadata.
    void rewrite(const std::string& metadata) const {
        std::vector<std::byte> bytes;
        {
            container::File file;
            ASSERT_TRUE(container::open(map().string(), file).ok());
            SphericalMap changed = file.map();
            changed.metadata = metadata;
            ASSERT_TRUE(container::write(changed, {}, bytes).ok());
        }
        write_file(map(), {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    }
    [[nodiscard]] fs::path asset() const { return folder_.path() / "a.obj"; }
    [[nodiscard]] fs::path library() const { return folder_.path() / "m.mtl"; }
    [[nodiscard]] fs::path map() const { return folder_.path() / "a.spa"; }

    TemporaryFolder folder_;
};

TEST_F(UpToDate, NoMapIsNew) {
    fs::remove(map());
    EXPECT_EQ(reason(), BakeReason::first);
}

TEST_F(UpToDate, FactsComeFromTheMap) {
    const MapState state = judge();
    EXPECT_EQ(state.facts.triangles, 4U);
    EXPECT_EQ(state.facts.source_bytes, fs::file_size(asset()) + fs::file_size(library()));
    EXPECT_EQ(state.facts.bytes, fs::file_size(map()));
    EXPECT_EQ(state.facts.figures, "");
}

TEST_F(UpToDate, TouchedIsNotChanged) {
    fs::last_write_time(asset(), fs::file_time_type::clock::now());
    EXPECT_EQ(reason(), BakeReason::none);
    write_file(library(), read_file(library()));
    EXPECT_EQ(reason(), BakeReason::none);
}

TEST_F(UpToDate, ChangedContentOfTheSameSizeAndTime) {
    const fs::file_time_type time = fs::last_write_time(asset());
    std::string changed = object;
    changed[changed.find("v 0 0 1") + 6] = '2';
    write_file(asset(), changed);
    fs::last_write_time(asset(), time);
    EXPECT_EQ(reason(), BakeReason::sources);
}

TEST_F(UpToDate, ChangedReference) {
    write_file(library(), "newmtl red\nKd 0 1 0\nmap_Kd t.png\n");
    EXPECT_EQ(reason(), BakeReason::sources);
}

TEST_F(UpToDate, ReferenceThatIsGone) {
    fs::remove(library());
    EXPECT_EQ(reason(), BakeReason::sources);
}

TEST_F(UpToDate, MissingReferenceThatAppears) {
    write_file(folder_.path() / "t.png", "even if it is no picture");
    EXPECT_EQ(reason(), BakeReason::sources);
}

TEST_F(UpToDate, OtherOptions) {
    bake({"--layers", "1"});
    EXPECT_EQ(reason(), BakeReason::options);
}

TEST_F(UpToDate, OtherVersion) {
    std::string metadata = read_metadata();
    auto json = nlohmann::ordered_json::parse(metadata);
    json["generator"]["version"] = "0.0.1";
    rewrite(json.dump());
    EXPECT_EQ(reason(), BakeReason::damaged) << "the key is of another version";
}

TEST_F(UpToDate, DamagedMaps) {
    const std::string good = read_file(map());
    write_file(map(), good.substr(0, good.size() / 2));
    EXPECT_EQ(reason(), BakeReason::damaged);
    write_file(map(), "");
    EXPECT_EQ(reason(), BakeReason::damaged);
    write_file(map(), good);
    EXPECT_EQ(reason(), BakeReason::none);
    auto json = nlohmann::ordered_json::parse(read_metadata());
    json["source"]["files"][1]["xxh3"] = "0123456789abcdef";
    rewrite(json.dump());
    EXPECT_EQ(reason(), BakeReason::damaged) << "a key that does not fit the files";
    for (const char* text : {"{}", R"({"key": 1})", R"({"key":"x","source":{"files":[],"missing":[]}})"}) {
        rewrite(text);
        EXPECT_EQ(reason(), BakeReason::damaged) << text;
    }
}

TEST_F(UpToDate, NamesThatLeadOutOfTheFolderAreNotFollowed) {
    auto json = nlohmann::ordered_json::parse(read_metadata());
    for (const char* name : {"../a.obj", "/etc/passwd", "x/../../a"}) {
        json["source"]["files"][1]["name"] = name;
        rewrite(json.dump());
        EXPECT_EQ(judge().freshness, Freshness::stale) << name;
    }
}

TEST_F(UpToDate, RenamedAssetIsAnother) {
    fs::rename(asset(), folder_.path() / "b.obj");
    BakeSettings settings;
    settings.options.grid = settings.options.color_grid = {Mapping::octahedral, 9, 9};
    EXPECT_EQ(tools::judge_map(map(), folder_.path() / "b.obj", settings, anything).reason,
              BakeReason::sources);
}

// What is remembered of the sources' state spares reading them, and nothing else.
class RememberedSources : public UpToDate {
protected:
    void SetUp() override {
        UpToDate::SetUp();
        removexattr(map().c_str(), "user.spa.sources");
        remember();
        if (getxattr(map().c_str(), "user.spa.sources", nullptr, 0) <= 0)
            GTEST_SKIP() << "the file system of the temporary folder has no extended attributes";
        ASSERT_EQ(judge(nothing).freshness, Freshness::current);
    }
};

TEST_F(RememberedSources, OtherStatesAreLookedInto) {
    fs::last_write_time(library(), fs::file_time_type::clock::now());
    EXPECT_EQ(judge(nothing).freshness, Freshness::unknown);
    EXPECT_EQ(judge(anything).freshness, Freshness::current);
}

TEST_F(RememberedSources, SameContentInAnotherFileIsLookedInto) {
    const fs::file_time_type time = fs::last_write_time(asset());
    write_file(folder_.path() / "copy", object);
    fs::last_write_time(folder_.path() / "copy", time);
    fs::rename(folder_.path() / "copy", asset());
    EXPECT_EQ(judge(nothing).freshness, Freshness::unknown);
}

TEST_F(RememberedSources, TheAttributeOfAnotherMapDoesNotCount) {
    std::array<char, 64> value{};
    const ssize_t length = getxattr(map().c_str(), "user.spa.sources", value.data(), value.size());
    ASSERT_GT(length, 0);
    std::string changed = object;
    changed[changed.find("v 0 0 1") + 6] = '2';
    write_file(asset(), changed); // the map baked from it gets the attribute of the one before
    bake();
    write_file(asset(), object);
    setxattr(map().c_str(), "user.spa.sources", value.data(), std::size_t(length), 0);
    EXPECT_EQ(judge(anything).reason, BakeReason::sources);
}

TEST_F(RememberedSources, NothingIsRememberedOfFilesThatJustChanged) {
    removexattr(map().c_str(), "user.spa.sources");
    write_file(library(), read_file(library()));
    EXPECT_EQ(judge(anything).freshness, Freshness::current);
    EXPECT_EQ(judge(nothing).freshness, Freshness::unknown);
}

} // namespace
} // namespace spa::test
