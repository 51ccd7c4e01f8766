// SPDX-License-Identifier: Apache-2.0
#include "file_parts.h"
#include "temporary_folder.h"
#include "test_maps.h"

#include "../../formats/container/reader.h"

#include <csignal>
#include <fstream>

#include <gtest/gtest.h>
#include <sys/resource.h>

namespace spa::test {
namespace {

using namespace spa::container;

Status write_bytes(const SphericalMap& map) {
    FileBytes bytes;
    const Status status = container::write(map, {}, bytes);
    EXPECT_EQ(bytes.empty(), !status.ok());
    return status;
}

std::string content(const std::string& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

TEST(Writer, FileIsWhatTheBytesAre) {
    const TemporaryFolder folder;
    const TestMap map = make_map({TestPart{}});
    for (const Compression compression : {Compression::none, Compression::zstd}) {
        const Status status = container::write(map.map, {.compression = compression}, folder.file("a.spa"));
        ASSERT_TRUE(status.ok()) << describe(status, "a.spa");
        const FileBytes bytes = write(map.map, compression);
        EXPECT_EQ(content(folder.file("a.spa")),
                  std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
        EXPECT_EQ(folder.file_count(), 1U);
    }
}

TEST(Writer, RefusesMapsThatBreakTheRules) {
    EXPECT_EQ(write_bytes({}).issue, Issue::wrong_parts_length);
    const auto status_of = [](auto edit) {
        TestMap map = make_map({TestPart{}});
        edit(map.map, map);
        return write_bytes(map.map);
    };
    EXPECT_TRUE(status_of([](SphericalMap&, TestMap&) {}).ok());
    EXPECT_EQ(status_of([](SphericalMap& m, TestMap&) { m.parts[0].radius = -1; }).issue,
              Issue::part_number_not_valid);
    EXPECT_EQ(status_of([](SphericalMap& m, TestMap&) { m.parts[0].layers.clear(); }).issue,
              Issue::no_layers);
    EXPECT_EQ(status_of([](SphericalMap& m, TestMap&) { m.parts[0].layers[1].outer.color = {}; }).issue,
              Issue::image_missing);
    EXPECT_EQ(status_of([](SphericalMap& m, TestMap&) { m.parts[0].layers[0].inner.depth = {}; }).issue,
              Issue::image_missing);
    EXPECT_EQ(status_of([](SphericalMap& m, TestMap&) { m.parts[0].mapping = Mapping(9); }).issue,
              Issue::unknown_mapping);
    EXPECT_EQ(status_of([](SphericalMap& m, TestMap&) { m.parts[0].layers[0].outer.depth.width = 4; }).issue,
              Issue::image_view_not_valid);
    EXPECT_EQ(status_of([](SphericalMap& m, TestMap&) {
                  m.parts[0].layers[0].outer.color.format = ElementFormat(99);
              }).issue,
              Issue::image_view_not_valid);
    EXPECT_EQ(status_of([](SphericalMap& m, TestMap&) {
                  std::swap(m.parts[0].layers[0].outer.depth, m.parts[0].layers[0].inner.depth);
              }).issue,
              Issue::interval_inside_out);
    EXPECT_EQ(
        status_of([](SphericalMap& m, TestMap&) { m.parts[0].mixed = m.parts[0].mixed.first(3); }).issue,
        Issue::wrong_mixed_length);
    EXPECT_EQ(
        status_of([](SphericalMap& m, TestMap&) { m.parts[0].folds = m.parts[0].folds.first(9); }).issue,
        Issue::wrong_fold_length);
    EXPECT_EQ(status_of([](SphericalMap& m, TestMap&) { m.parts[0].mixed = {}; }).issue,
              Issue::fold_part_not_valid);
    EXPECT_EQ(status_of([](SphericalMap&, TestMap& t) { t.pixels.back()->front() = std::byte{12}; }).issue,
              Issue::fold_edge_not_valid);
    EXPECT_EQ(status_of([](SphericalMap& m, TestMap&) { m.metadata = "{"; }).issue, Issue::metadata_not_json);
    TestMap holes = make_map({TestPart{.width = 17, .height = 17, .folds = false}});
    std::fill(holes.pixels.back()->begin(), holes.pixels.back()->end(), std::byte{});
    EXPECT_EQ(write_bytes(holes.map).issue, Issue::corners_differ);
    const Status status = status_of([](SphericalMap&, TestMap& t) {
        (*t.pixels[0])[3] ^= std::byte{1}; // depth of layer 0 on the upper border
    });
    EXPECT_EQ(status.issue, Issue::border_differs);
    EXPECT_EQ(type_name(status.type), "DPTH");
}

TEST(Writer, TooManyLayersForTheFormat) {
    TestMap map = make_map({TestPart{}});
    map.map.parts[0].layers.resize(65536, map.map.parts[0].layers[0]);
    EXPECT_EQ(write_bytes(map.map).issue, Issue::no_layers);
}

TEST(Writer, FailureLeavesNothingBehind) {
    const TemporaryFolder folder;
    const std::string path = folder.file("a.spa");
    std::ofstream(path) << "before";

    SphericalMap wrong = make_map({TestPart{}}).map;
    wrong.parts[0].radius = 0;
    EXPECT_FALSE(container::write(wrong, {}, path).ok());
    EXPECT_EQ(content(path), "before");
    EXPECT_EQ(folder.file_count(), 1U);

    const Status status = container::write(make_example().map, {}, folder.file("no/such/folder/a.spa"));
    EXPECT_EQ(status.issue, Issue::cannot_write);
    EXPECT_NE(describe(status, "a.spa").find("No such file"), std::string::npos);
    EXPECT_EQ(exit_code(status.issue), ExitCode::input_output);
    EXPECT_EQ(folder.file_count(), 1U);
}

TEST(Writer, AFullDiskLeavesNothingBehind) {
    const TemporaryFolder folder;
    const std::string path = folder.file("a.spa");
    std::ofstream(path) << "before";

    // A limit on the length of files fails as a full disk does, in the middle of a write.
    rlimit before{};
    ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
    const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit small{1000, before.rlim_max};
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
    const Status status =
        container::write(make_map({TestPart{}}).map, {.compression = Compression::none}, path);
    ::setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, old_handler);

    EXPECT_EQ(status.issue, Issue::cannot_write);
    EXPECT_NE(status.system_error, 0);
    EXPECT_EQ(content(path), "before");
    EXPECT_EQ(folder.file_count(), 1U);
}

TEST(Writer, AFolderInTheWayIsAnError) {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder.file("a.spa"));
    EXPECT_EQ(container::write(make_example().map, {}, folder.file("a.spa")).issue, Issue::cannot_write);
    EXPECT_EQ(folder.file_count(), 1U);
}

TEST(Writer, DevicesAreWrittenToDirectly) {
    EXPECT_TRUE(container::write(make_example().map, {}, std::string("/dev/null")).ok());
    EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
    EXPECT_EQ(container::write(make_example().map, {}, std::string("/dev/full")).issue, Issue::cannot_write);
}

} // namespace
} // namespace spa::test
