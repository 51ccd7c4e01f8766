// SPDX-License-Identifier: Apache-2.0
// Every number is reported for its fixtures, and what is allowed is not refused.
#include "issue_fixtures.h"
#include "test_maps.h"
#include "version_1_0.h"

#include "../../formats/container/reader.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace spa::test {
namespace {

using namespace spa::container;

TEST(Issues, TheGoodFileIsGood) {
    const Status status = check(good_file());
    EXPECT_TRUE(status.ok()) << describe(status, "file");
    EXPECT_TRUE(check(compressed_file(Scheme::zstd)).ok());
    EXPECT_TRUE(check(with_f32_depth(0.8F)).ok());
}

TEST(Issues, EachFixtureIsRefusedWithItsNumber) {
    for (const auto& [issue, make] : file_fixtures()) {
        const FileBytes file = make();
        const Status status = check(file);
        EXPECT_EQ(number(status.issue), number(issue)) << describe(status, "file");
        const std::string text = describe(status, "some.spa");
        EXPECT_EQ(text.find("some.spa: " + number(issue) + ": "), 0U) << text;
        EXPECT_NE(text.find("byte"), std::string::npos) << text;

        // The readers agree with the checker and give no map.
        File opened;
        EXPECT_EQ(open(std::span<const std::byte>(file), opened).issue, issue);
        EXPECT_TRUE(opened.map().parts.empty());
    }
}

TEST(Issues, EachLimitIsRefusedWithItsNumber) {
    for (const auto& [issue, limits] : limit_fixtures()) {
        const Status status = check(good_file(), limits);
        EXPECT_EQ(number(status.issue), number(issue)) << describe(status, "file");
    }
}

TEST(Issues, EveryNumberHasAFixture) {
    // Files and memory that fail: reader_test.cpp, writer_test.cpp, allocation_test.cpp.
    const std::vector<Issue> elsewhere{Issue::cannot_open, Issue::cannot_read, Issue::cannot_write,
                                       Issue::image_view_not_valid, Issue::out_of_memory};
    for (const IssueEntry& entry : issue_table) {
        const bool found = file_fixtures().count(entry.issue) != 0 ||
                           limit_fixtures().count(entry.issue) != 0 ||
                           std::count(elsewhere.begin(), elsewhere.end(), entry.issue) != 0;
        EXPECT_TRUE(found) << number(entry.issue) << " " << entry.name;
    }
}

TEST(Issues, TableIsAscendingAndComplete) {
    for (std::size_t i = 1; i < issue_table.size(); ++i)
        EXPECT_LT(issue_table[i - 1].issue, issue_table[i].issue);
    for (const IssueEntry& entry : issue_table) EXPECT_FALSE(entry.text.empty() || entry.advice.empty());
    EXPECT_EQ(find(Issue::none), nullptr);
    EXPECT_EQ(describe({}, "file"), "");
}

TEST(Sections, UnknownOptionalOnesAreSkipped) {
    const FileBytes file = with_unknown_section(0);
    File opened;
    const Status status = open(std::span<const std::byte>(file), opened);
    ASSERT_TRUE(status.ok()) << describe(status, "file");
    EXPECT_TRUE(same(opened.map(), make_map({TestPart{}}).map));
    EXPECT_EQ(type_name(opened.sections().back().type), "FOLD");

    // Their checksums count all the same.
    FileBytes damaged = file;
    damaged.back() ^= std::byte{1};
    EXPECT_EQ(check(damaged).issue, Issue::checksum_mismatch);
}

TEST(Sections, OrderOfImagesIsFree) {
    const FileBytes file =
        edited(good_file(), [](FileParts& f) { std::reverse(f.sections.begin() + 1, f.sections.end()); });
    File opened;
    ASSERT_TRUE(open(std::span<const std::byte>(file), opened).ok());
    EXPECT_TRUE(same(opened.map(), make_map({TestPart{}}).map));
}

TEST(Versions, NewerMinorIsReadWithWhatItReserves) {
    FileBytes file = with_unknown_section(0xF0, version_minor + 1);
    EXPECT_TRUE(check(file).ok());
    EXPECT_TRUE(check(with_value(file, 30, std::uint8_t(1))).ok());
    const FileBytes reserved = edited(file, [](FileParts& f) {
        f.sections[0].stored[191] = std::byte{1};
        f.sections[0].stored[155] = std::byte{0x80};
        f.sections[2].entry.flags |= 4U;
    });
    const Status status = check(reserved);
    EXPECT_TRUE(status.ok()) << describe(status, "file");
    EXPECT_EQ(check(with_unknown_section(flag_required, 9)).issue, Issue::unknown_required_section);
    File opened;
    ASSERT_TRUE(open(std::span<const std::byte>(reserved), opened).ok());
    EXPECT_TRUE(same(opened.map(), make_map({TestPart{}}).map));
}

TEST(Versions, AFileOfVersion10IsReadAsItWas) {
    const FileBytes file = version_1_0_file();
    File opened;
    const Status status = open(std::span<const std::byte>(file), opened);
    ASSERT_TRUE(status.ok()) << describe(status, "file");
    EXPECT_EQ(opened.version().major, 1);
    EXPECT_EQ(opened.version().minor, 0);
    TestMap expected = make_example();
    expected.map.parts[0].center_inside = false;
    EXPECT_TRUE(same(opened.map(), expected.map));
    // What came later had no meaning then: the flags were reserved, and MIXD was any unknown section.
    EXPECT_EQ(check(edited(file, [](FileParts& f) { f.sections[0].stored[152] = std::byte{1}; })).issue,
              Issue::part_reserved_not_zero);
    const auto with_section = [&](std::uint32_t flags) {
        return edited(file, [&](FileParts& f) {
            Section section;
            section.entry.type = type_mixed;
            section.entry.flags = flags;
            section.entry.part = section.entry.width = 77;
            section.stored.resize(5);
            f.sections.push_back(section);
        });
    };
    ASSERT_TRUE(open(std::span<const std::byte>(with_section(0)), opened).ok());
    EXPECT_TRUE(opened.map().parts[0].mixed.empty());
    EXPECT_EQ(check(with_section(flag_required)).issue, Issue::unknown_required_section);
}

} // namespace
} // namespace spa::test
