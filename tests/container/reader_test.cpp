// SPDX-License-Identifier: Apache-2.0
#include "file_parts.h"
#include "temporary_folder.h"
#include "test_maps.h"

#include "../../formats/container/reader.h"

#include <fstream>
#include <thread>

#include <gtest/gtest.h>
#include <sys/stat.h>

namespace spa::test {
namespace {

using namespace spa::container;

void save(const std::string& path, const FileBytes& bytes) {
    std::ofstream stream(path, std::ios::binary);
    stream.write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
}

TEST(Reader, FilesMappedAndRead) {
    const TemporaryFolder folder;
    const TestMap map = make_map({TestPart{}, TestPart{}});
    for (const Compression compression : {Compression::none, Compression::zstd}) {
        const std::string path = folder.file("map.spa");
        save(path, write(map.map, compression));
        for (const bool map_file : {true, false}) {
            File file;
            const Status status = open(path, file, {.map_file = map_file});
            ASSERT_TRUE(status.ok()) << describe(status, path);
            EXPECT_TRUE(same(file.map(), map.map));
            // What is read stays, whatever becomes of the name.
            File other = std::move(file);
            std::filesystem::remove(path);
            EXPECT_TRUE(same(other.map(), map.map));
            save(path, write(map.map, compression));
        }
    }
}

TEST(Reader, FilesThatAreNotRight) {
    const TemporaryFolder folder;
    FileBytes bytes = write(make_map({TestPart{}}).map);
    bytes.pop_back();
    save(folder.file("cut.spa"), bytes);
    save(folder.file("empty.spa"), {});
    for (const bool map_file : {true, false}) {
        const ReadOptions options{.map_file = map_file};
        File file;
        EXPECT_EQ(open(folder.file("cut.spa"), file, options).issue, Issue::file_truncated);
        EXPECT_EQ(open(folder.file("empty.spa"), file, options).issue, Issue::file_too_short);
        bytes.resize(bytes.size() + 2);
        save(folder.file("long.spa"), bytes);
        EXPECT_EQ(open(folder.file("long.spa"), file, options).issue, Issue::file_too_long);
        EXPECT_EQ(
            open(folder.file("long.spa"), file, {.limits = {.file_bytes = 100}, .map_file = map_file}).issue,
            Issue::too_many_bytes);
    }
}

TEST(Reader, FilesThatCannotBeOpenedOrRead) {
    const TemporaryFolder folder;
    File file;
    Status status = open(folder.file("missing.spa"), file);
    EXPECT_EQ(status.issue, Issue::cannot_open);
    EXPECT_EQ(exit_code(status.issue), ExitCode::input_output);
    const std::string text = describe(status, "missing.spa");
    EXPECT_NE(text.find("SPA-801"), std::string::npos) << text;
    EXPECT_NE(text.find("No such file"), std::string::npos) << text;

    status = open(folder.path(), file);
    EXPECT_EQ(status.issue, Issue::cannot_read);
    EXPECT_NE(describe(status, "folder").find("directory"), std::string::npos) << describe(status, "folder");
}

TEST(Reader, PipesAreReadAsStreams) {
    const TemporaryFolder folder;
    const std::string path = folder.file("pipe");
    ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
    const TestMap map = make_map({TestPart{}});
    std::thread feeder([&] { save(path, write(map.map, Compression::zstd)); });
    File file;
    const Status status = open(path, file);
    feeder.join();
    ASSERT_TRUE(status.ok()) << describe(status, path);
    EXPECT_TRUE(same(file.map(), map.map));
}

TEST(Reader, FailureLeavesTheFileEmpty) {
    File file;
    const FileBytes good = write(make_map({TestPart{}}).map);
    ASSERT_TRUE(open(std::span<const std::byte>(good), file).ok());
    EXPECT_FALSE(open(std::span<const std::byte>(good).first(100), file).ok());
    EXPECT_TRUE(file.map().parts.empty());
    EXPECT_TRUE(file.sections().empty());
    EXPECT_EQ(file.length(), 0U);
}

TEST(Reader, SectionsAreListed) {
    const FileBytes bytes = write(make_map({TestPart{}}).map, Compression::zstd);
    File file;
    ASSERT_TRUE(open(std::span<const std::byte>(bytes), file).ok());
    ASSERT_EQ(file.sections().size(), 13U);
    EXPECT_EQ(type_name(file.sections()[0].type), "PART");
    EXPECT_EQ(type_name(file.sections()[1].type), "META");
    const SectionEntry& color = file.sections()[10];
    EXPECT_EQ(type_name(color.type), "COLR");
    EXPECT_EQ(color.layer, 1);
    EXPECT_EQ(color.raw_length, 9U * 9U * 4U);
    const SectionEntry& mixed = file.sections()[11];
    EXPECT_EQ(type_name(mixed.type), "MIXD");
    EXPECT_EQ(mixed.raw_length, 4U * 4U / 4U);
    const SectionEntry& fold = file.sections()[12];
    EXPECT_EQ(type_name(fold.type), "FOLD");
    EXPECT_EQ(fold.raw_length, 12U * 10U);
    EXPECT_EQ(fold.offset + fold.stored_length, bytes.size());
}

TEST(Reader, MessagesSayWhere) {
    Status status;
    status.issue = Issue::checksum_mismatch;
    status.section = 4;
    status.type = type_depth;
    status.part = 2;
    status.layer = 1;
    status.side = 1;
    status.offset = 640;
    EXPECT_EQ(
        describe(status, "a.spa"),
        "a.spa: SPA-402: the stored bytes do not have their checksum, in section 4 (DPTH of part 2, layer 1, "
        "inner), byte 640 of the file. The file is damaged: fetch it again or bake it again.");
}

} // namespace
} // namespace spa::test
