// SPDX-License-Identifier: Apache-2.0
// Every number is reported for its fixtures, and what is allowed is not refused.
#include "issue_fixtures.h"
#include "old_versions.h"
#include "test_maps.h"

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
    EXPECT_EQ(type_name(opened.sections().back().type), "XTRA");

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

// The good file has three crossings at each end.
TEST(FoldIssues, RecordsCountWhatEarlierOnesOfTheirEndAndEdgeLeave) {
    const auto record = [](std::uint32_t edge, bool pair, unsigned end, unsigned index) {
        const std::uint16_t second = pair ? 1 : 0;
        return FoldRecord{edge, pair, std::uint8_t(end), std::uint8_t(index), 255, {65535, second}};
    };
    const std::vector<std::vector<FoldRecord>> valid{
        {record(0, false, 0, 2), record(0, false, 0, 1), record(0, false, 0, 0)},
        {record(0, false, 0, 0), record(0, false, 1, 2), record(0, false, 0, 0), record(0, true, 1, 0)},
        {record(0, true, 0, 1), record(0, true, 1, 1), record(1, true, 0, 1), record(2, true, 0, 0)},
        {record(0, false, 0, 2), record(58, false, 0, 2), record(69, false, 1, 2)},
        {record(69, true, 0, 0), record(69, false, 0, 0)}};
    for (std::vector<FoldRecord> records : valid) {
        const Status status = check(with_folds(records));
        EXPECT_TRUE(status.ok()) << describe(status, "file");
        // One more than there are.
        const FoldRecord last = records.back();
        for (unsigned left = 0; left < 4; ++left) records.push_back(record(last.edge, false, last.end, 0));
        EXPECT_EQ(check(with_folds(records)).issue, Issue::fold_index_not_valid);
    }
}

TEST(FoldIssues, MessagesPointAtTheRecord) {
    const FoldRecord good{0, false, 0, 0, 1, {1, 0}};
    const auto offset = [&](const FoldRecord& bad) {
        const Status status = check(with_folds({good, bad, good}));
        EXPECT_EQ(type_name(status.type), "FOLD");
        EXPECT_TRUE(status.decoded);
        EXPECT_NE(describe(status, "file").find("(FOLD of part 0)"), std::string::npos)
            << describe(status, "file");
        return status.offset;
    };
    EXPECT_EQ(offset({12, false, 0, 0, 1, {1, 0}}), 0U * 3 + 1);
    EXPECT_EQ(offset({0, false, 0, 3, 1, {1, 0}}), 4U * 3 + 1);
    EXPECT_EQ(offset({0, false, 0, 0, 1, {0, 0}}), 6U * 3 + 1);
}

// A triangle of another edge does not matter.
TEST(FoldIssues, OnlyTheTrianglesAtTheEdgeHaveToBeMixed) {
    constexpr std::uint32_t cells = 4;
    std::vector<std::vector<std::uint64_t>> at_edge(edge_count(cells));
    for (std::uint32_t y = 0; y < cells; ++y)
        for (std::uint32_t x = 0; x < cells; ++x)
            for (const unsigned triangle : {0U, 1U})
                for (const TriangleEdge& e : triangle_edges(cells, x, y, triangle))
                    at_edge[e.edge].push_back(triangle_bit(cells, x, y, triangle));
    for (std::uint32_t edge = 0; edge < edge_count(cells); ++edge) {
        if (!is_edge(cells, edge)) continue;
        for (std::uint64_t bit = 0; bit < 8 * mixed_bytes(cells); ++bit) {
            const bool matters = std::count(at_edge[edge].begin(), at_edge[edge].end(), bit) != 0;
            EXPECT_EQ(check(with_folds({{edge, false, 0, 0, 1, {1, 0}}}, {bit})).issue,
                      matters ? Issue::fold_on_pure_triangle : Issue::none)
                << edge << " " << bit;
        }
    }
}

// Numbers of edges have 32 bits. The images of so large a map are only said to be there.
TEST(FoldIssues, MapsHaveNoMoreCellsThanEdgesHaveNumbers) {
    for (const std::uint32_t cells : {most_numbered_cells, most_numbered_cells + 2}) {
        TestPart part;
        part.layers = 1;
        part.depth = ElementFormat::u8;
        const FileBytes file = edited(write(make_map({part}).map), [&](FileParts& f) {
            Section& depth = f.find(type_depth);
            depth.entry.width = depth.entry.height = cells + 1;
            depth.entry.raw_length = std::uint64_t(cells + 1) * (cells + 1);
            Section& mixed = f.find(type_mixed);
            mixed.entry.raw_length = mixed_bytes(cells);
            for (Section* section : {&depth, &mixed}) {
                section->entry.scheme = Scheme::zstd;
                section->stored.resize(std::size_t(section->entry.raw_length / 32768 + 1));
            }
        });
        const Status status = check(file, no_limits, CheckDepth::structure);
        EXPECT_EQ(status.issue, cells > most_numbered_cells ? Issue::fold_part_not_valid : Issue::none)
            << describe(status, "file");
    }
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

TEST(Versions, AFileOfVersion11IsReadAsItWas) {
    const FileBytes file = version_1_1_file();
    File opened;
    const Status status = open(std::span<const std::byte>(file), opened);
    ASSERT_TRUE(status.ok()) << describe(status, "file");
    EXPECT_EQ(opened.version().major, 1);
    EXPECT_EQ(opened.version().minor, 1);
    TestMap expected = make_example();
    const std::array<std::byte, 1> mixed{std::byte{0x21}};
    expected.map.parts[0].mixed = mixed;
    EXPECT_TRUE(same(opened.map(), expected.map));
    EXPECT_EQ(check(edited(file, [](FileParts& f) { f.sections[0].stored[152] = std::byte{2}; })).issue,
              Issue::unknown_part_flags);
    // FOLD was any unknown section, whatever it holds and says about itself.
    const auto with_section = [&](std::uint32_t flags, std::uint16_t minor) {
        return edited(file, [&](FileParts& f) {
            Section section;
            section.entry.type = type_fold;
            section.entry.flags = flags;
            section.entry.part = section.entry.width = 77;
            section.stored.resize(5);
            f.sections.push_back(section);
            f.minor = minor;
        });
    };
    const FileBytes unknown = with_section(0, 1);
    ASSERT_TRUE(open(std::span<const std::byte>(unknown), opened).ok());
    EXPECT_TRUE(same(opened.map(), expected.map));
    EXPECT_EQ(check(with_section(flag_required, 1)).issue, Issue::unknown_required_section);
    EXPECT_EQ(check(with_section(0, 2)).issue, Issue::fold_fields_not_zero);
}

TEST(Versions, BindMeansNothingBeforeVersion13) {
    const TestMap map = make_map({TestPart{}, TestPart{}});
    const auto as_of = [&](std::uint16_t minor) {
        return edited(write(map.map), [&](FileParts& f) { f.minor = minor; });
    };
    File opened;
    const FileBytes now = as_of(3), before = as_of(2);
    ASSERT_TRUE(open(std::span<const std::byte>(now), opened).ok());
    EXPECT_TRUE(same(opened.map(), map.map));
    ASSERT_TRUE(open(std::span<const std::byte>(before), opened).ok());
    EXPECT_EQ(opened.map().parts[1].to_node, Affine{});
}

} // namespace
} // namespace spa::test
