// SPDX-License-Identifier: Apache-2.0
#include "../../libspa/core/error.h"
#include "../../tools/batch_assets.h"
#include "../cli/process.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace spa::test {
namespace {

namespace fs = std::filesystem;
using tools::AssetList;
using tools::AssetQuery;
using tools::BatchAsset;

// A folder of files that are only listed.
class FindAssets : public testing::Test {
protected:
    fs::path make(const std::string& name) {
        const fs::path path = in() / name;
        fs::create_directories(path.parent_path());
        write_file(path, "x");
        return path;
    }
    [[nodiscard]] fs::path in() const { return folder_.path() / "in"; }
    [[nodiscard]] AssetQuery query() const {
        AssetQuery query;
        query.inputs = {in().string()};
        query.output = "out";
        return query;
    }
    static std::vector<std::string> names(const AssetList& list) {
        std::vector<std::string> names;
        for (const BatchAsset& asset : list.assets) names.push_back(asset.name);
        return names;
    }
    static std::vector<std::string> outputs(const AssetList& list) {
        std::vector<std::string> names;
        for (const BatchAsset& asset : list.assets) names.push_back(asset.output.string());
        return names;
    }
    using Names = std::vector<std::string>;

    TemporaryFolder folder_;
};

TEST_F(FindAssets, AllFormatsAtAnyDepthInOrder) {
    for (const char* name : {"z.obj", "props/boot.glb", "props/boot.bin", "a/b/c/d.STL", "B.gltf", "x.ply",
                             "y.off", "readme.txt", "x.mtl", ".hidden/h.obj", "obj"})
        make(name);
    const AssetList list = find_assets(query());
    EXPECT_EQ(names(list),
              (Names{".hidden/h.obj", "B.gltf", "a/b/c/d.STL", "props/boot.glb", "x.ply", "y.off", "z.obj"}));
    EXPECT_EQ(outputs(list), (Names{"out/.hidden/h.spa", "out/B.spa", "out/a/b/c/d.spa", "out/props/boot.spa",
                                    "out/x.spa", "out/y.spa", "out/z.spa"}));
    EXPECT_EQ(list.assets[3].path, in() / "props/boot.glb");
    EXPECT_EQ(list.assets[3].bytes, 1U);
}

TEST_F(FindAssets, SameStemKeepsTheWholeName) {
    for (const char* name : {"a.obj", "a.glb", "b.obj", "x/a.obj", "a.glb.ply"}) make(name);
    EXPECT_EQ(outputs(find_assets(query())),
              (Names{"out/a.glb.spa", "out/a.glb.ply.spa", "out/a.obj.spa", "out/b.spa", "out/x/a.spa"}));
    AssetQuery one = query();
    one.include = {"/a.obj"};
    EXPECT_EQ(outputs(find_assets(one)), Names{"out/a.obj.spa"}) << "a pattern changes the name of an output";
}

TEST_F(FindAssets, IncludeAndExclude) {
    for (const char* name : {"a.obj", "props/b.obj", "props/old/c.obj", "d.glb"}) make(name);
    AssetQuery chosen = query();
    chosen.include = {"*.obj", "d.*"};
    chosen.exclude = {"old", "a.*"};
    EXPECT_EQ(names(find_assets(chosen)), (Names{"d.glb", "props/b.obj"}));
}

TEST_F(FindAssets, FilesAndLists) {
    make("props/a.obj");
    make("model");
    make("b.obj");
    AssetQuery files = query();
    files.inputs = {(in() / "props/a.obj").string(), (in() / "model").string()};
    EXPECT_EQ(outputs(find_assets(files)), (Names{"out/a.spa", "out/model.spa"}));

    const fs::path before = fs::current_path();
    fs::current_path(in());
    write_file("lines", "props/a.obj\n\n./b.obj\n" + (in() / "model").string() + "\nnone.glb\n");
    AssetQuery lines = query();
    lines.inputs = {"@lines"};
    const AssetList list = find_assets(lines);
    fs::current_path(before);
    EXPECT_EQ(names(list), (Names{"b.obj", "model", "none.glb", "props/a.obj"}));
    EXPECT_EQ(outputs(list), (Names{"out/b.spa", "out/model.spa", "out/none.spa", "out/props/a.spa"}));
    EXPECT_NE(list.assets[2].problem.find("no such file"), std::string::npos);
    EXPECT_EQ(list.assets[3].problem, "");
}

TEST_F(FindAssets, ListEndedByZeroBytesMayHaveLineBreaksInNames) {
    const std::string odd = make("two\nlines.obj").string(), other = make("b.obj").string();
    const fs::path list_file = folder_.path() / "list";
    write_file(list_file, odd + '\0' + other + '\0');
    AssetQuery zero = query();
    zero.inputs = {"@" + list_file.string()};
    const AssetList list = find_assets(zero);
    EXPECT_EQ(names(list), (Names{"b.obj", "two\nlines.obj"}));
    EXPECT_EQ(list.assets[1].problem, "");
}

TEST_F(FindAssets, AFileNamedTwiceIsOneAsset) {
    make("a.obj");
    AssetQuery twice = query();
    twice.inputs = {in().string(), in().string() + "/", (in() / "a.obj").string()};
    EXPECT_EQ(names(find_assets(twice)), Names{"a.obj"});
}

TEST_F(FindAssets, TwoAssetsForOneOutputAreRefused) {
    make("x/a.obj");
    make("y/a.obj");
    AssetQuery both = query();
    both.inputs = {(in() / "x").string(), (in() / "y").string()};
    try {
        find_assets(both);
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::usage);
        EXPECT_NE(std::string(error.what()).find("x/a.obj"), std::string::npos);
        EXPECT_NE(std::string(error.what()).find("y/a.obj"), std::string::npos);
    }
}

TEST_F(FindAssets, WhatIsNotThereIsAnError) {
    AssetQuery none = query();
    none.inputs = {(in() / "none").string()};
    EXPECT_THROW(find_assets(none), Error);
    none.inputs = {"@" + (in() / "none").string()};
    EXPECT_THROW(find_assets(none), Error);
}

TEST_F(FindAssets, AnyBytesInNames) {
    const std::string long_name = std::string(251, 'n') + ".obj";
    const Names odd{" .obj", "-o.obj", "a b.obj", "new\nline.obj", "quo\"te'.obj", "\xff\xfe.obj", long_name};
    for (const std::string& name : odd) make(name);
    Names sorted = odd;
    std::sort(sorted.begin(), sorted.end());
    const AssetList list = find_assets(query());
    EXPECT_EQ(names(list), sorted);
    EXPECT_EQ(fs::path(list.assets.back().output).filename().string(), "\xff\xfe.spa");
}

TEST_F(FindAssets, LinksToFoldersOnlyOnDemandAndNoLoops) {
    make("a.obj");
    make("sub/b.obj");
    fs::create_directory_symlink(in(), in() / "sub/up");
    fs::create_directory_symlink(".", in() / "self");
    const TemporaryFolder elsewhere;
    write_file(elsewhere.path() / "c.obj", "x");
    fs::create_directory_symlink(elsewhere.path(), in() / "linked");
    const AssetList cautious = find_assets(query());
    EXPECT_EQ(names(cautious), (Names{"a.obj", "sub/b.obj"}));
    ASSERT_EQ(cautious.warnings.size(), 1U);
    EXPECT_EQ(cautious.warnings[0].rfind("3 symbolic links", 0), 0U) << cautious.warnings[0];

    AssetQuery follow = query();
    follow.follow_links = true;
    const AssetList all = find_assets(follow);
    EXPECT_EQ(names(all), (Names{"a.obj", "linked/c.obj", "sub/b.obj"}));
    EXPECT_EQ(all.warnings.size(), 2U);
}

TEST_F(FindAssets, LinksToFilesOutsideAreRefused) {
    make("a.obj");
    const TemporaryFolder elsewhere;
    write_file(elsewhere.path() / "c.obj", "x");
    fs::create_symlink(elsewhere.path() / "c.obj", in() / "out.obj");
    fs::create_symlink("a.obj", in() / "inside.obj");
    fs::create_symlink("nowhere.obj", in() / "broken.obj");
    const auto problems = [&](bool follow) {
        AssetQuery links = query();
        links.follow_links = follow;
        Names named;
        for (const BatchAsset& asset : find_assets(links).assets)
            if (!asset.problem.empty()) named.push_back(asset.name + ": " + asset.problem);
        return named;
    };
    EXPECT_EQ(problems(false),
              (Names{"broken.obj: no such file; check the path",
                     "out.obj: is a symbolic link that leads out of the folder; --follow-links allows it"}));
    EXPECT_EQ(problems(true), Names{"broken.obj: no such file; check the path"});
}

TEST_F(FindAssets, ShardsAreAPartitionThatNewAssetsDoNotChange) {
    for (int i = 0; i < 100; ++i) make("a" + std::to_string(i) + ".obj");
    const auto shards = [&] {
        std::vector<std::set<std::string>> shares;
        for (std::uint32_t index = 1; index <= 4; ++index) {
            AssetQuery one = query();
            one.shard = {index, 4};
            const Names share = names(find_assets(one));
            shares.emplace_back(share.begin(), share.end());
        }
        return shares;
    };
    const auto before = shards();
    std::set<std::string> together;
    for (const auto& share : before) {
        EXPECT_GT(share.size(), 10U); // of 25 on average; all names are given, so this does not change
        for (const std::string& name : share)
            EXPECT_TRUE(together.insert(name).second) << name << " is in two";
    }
    EXPECT_EQ(together.size(), 100U);
    make("a00.obj");
    const auto after = shards();
    for (std::size_t i = 0; i < 4; ++i)
        EXPECT_TRUE(std::includes(after[i].begin(), after[i].end(), before[i].begin(), before[i].end()));
}

} // namespace
} // namespace spa::test
