// SPDX-License-Identifier: Apache-2.0
// One file for each numbered issue, and the table of issues against the specification.
#include "file_parts.h"
#include "test_maps.h"

#include "../../formats/container/codec.h"
#include "../../formats/container/reader.h"

#include <algorithm>
#include <fstream>
#include <limits>
#include <map>
#include <sstream>

#include <gtest/gtest.h>

namespace spa::test {
namespace {

using namespace spa::container;

// META at section 1; images after it.
FileBytes good_file() { return write(make_map({TestPart{}}).map); }

// A file of which `edit` has changed the parts.
template <class Edit>
FileBytes edited(Edit edit, FileBytes file = good_file()) {
    FileParts parts = take_apart(file);
    edit(parts);
    return put_together(parts);
}

// A valid file with a value at an offset of the first part's record.
template <class T>
FileBytes with_part_value(std::size_t offset, T value) {
    return edited([&](FileParts& f) { store(f.sections[0].stored.data() + offset, value); });
}

FileBytes bytes_of(std::string_view text) {
    FileBytes bytes(text.size());
    std::transform(text.begin(), text.end(), bytes.begin(), [](char c) { return std::byte(c); });
    return bytes;
}

FileBytes with_metadata(std::string_view text) {
    return edited([&](FileParts& f) {
        Section& section = f.find(type_metadata);
        section.stored = bytes_of(text);
        section.entry.raw_length = text.size();
    });
}

FileBytes compressed_file(Scheme scheme) {
    return edited([&](FileParts& f) {
        Section& section = f.find(type_depth);
        section.entry.scheme = scheme;
        section.stored = compress(section.stored, 1);
    });
}

FileBytes with_unknown_section(std::uint32_t flags, std::uint16_t minor = version_minor) {
    return edited([&](FileParts& f) {
        Section section;
        section.entry.type = section_type("FOLD");
        section.entry.flags = flags;
        section.entry.scheme = Scheme(77);
        section.entry.raw_length = UINT64_MAX;
        section.stored = bytes_of("anything");
        f.sections.push_back(section);
        f.minor = minor;
    });
}

TestPart f32_part() {
    TestPart part;
    part.depth = ElementFormat::f32;
    return part;
}

FileBytes with_f32_depth(float value) {
    return edited([&](FileParts& f) { store(f.find(type_depth).stored.data() + 4 * 12, value); },
                  write(make_map({f32_part()}).map));
}

using Fixture = std::function<FileBytes()>;

// Files that a checker with default limits refuses with exactly this issue.
const std::multimap<Issue, Fixture>& file_fixtures() {
    static const std::multimap<Issue, Fixture> fixtures{
        {Issue::file_too_short, [] { return FileBytes{}; }},
        {Issue::file_too_short,
         [] {
             FileBytes file = good_file();
             file.resize(header_size - 1);
             return file;
         }},
        {Issue::not_a_spa_file, [] { return bytes_of(std::string(200, 'x')); }},
        {Issue::identifier_damaged,
         [] {
             FileBytes file = good_file();
             file.erase(file.begin() + 8); // CR LF -> LF
             return file;
         }},
        {Issue::version_not_supported, [] { return with_value(good_file(), 12, std::uint16_t(2)); }},
        {Issue::file_truncated,
         [] {
             FileBytes file = good_file();
             file.pop_back();
             return file;
         }},
        {Issue::file_too_long,
         [] {
             FileBytes file = good_file();
             file.push_back({});
             return file;
         }},
        {Issue::table_outside_file,
         [] {
             const FileBytes file = good_file();
             return with_value(file, 24, std::uint32_t((file.size() - header_size) / section_entry_size + 1));
         }},
        {Issue::table_checksum_mismatch,
         [] {
             FileBytes file = good_file();
             file[entry_field(1, 56)] ^= std::byte{1};
             return file;
         }},
        {Issue::header_reserved_not_zero, [] { return with_value(good_file(), 55, std::uint8_t(1)); }},

        {Issue::unknown_required_section, [] { return with_unknown_section(flag_required); }},
        {Issue::unknown_flags, [] { return with_unknown_section(2); }},
        {Issue::unknown_flags, [] { return with_value(good_file(), entry_field(2, 4), std::uint32_t(3)); }},
        {Issue::wrong_required_flag,
         [] { return with_value(good_file(), entry_field(1, 4), std::uint32_t(1)); }},
        {Issue::wrong_required_flag,
         [] { return with_value(good_file(), entry_field(2, 4), std::uint32_t(0)); }},
        {Issue::section_not_aligned,
         [] {
             const FileBytes file = good_file();
             return with_value(file, entry_field(2, 32), load<std::uint64_t>(&file[entry_field(2, 32)]) + 16);
         }},
        {Issue::sections_overlap,
         [] {
             const FileBytes file = good_file();
             return with_value(file, entry_field(2, 32), load<std::uint64_t>(&file[entry_field(1, 32)]));
         }},
        {Issue::gap_between_sections,
         [] {
             const FileBytes file = good_file();
             return with_value(file, entry_field(2, 32), load<std::uint64_t>(&file[entry_field(2, 32)]) + 64);
         }},
        {Issue::section_outside_file,
         [] {
             const std::size_t last = take_apart(good_file()).sections.size() - 1;
             return with_value(good_file(), entry_field(last, 40), UINT64_MAX - 100);
         }},
        {Issue::bytes_after_last_section,
         [] {
             FileBytes file = good_file();
             file.push_back({});
             return with_value(file, 16, std::uint64_t(file.size()));
         }},
        {Issue::unknown_scheme, [] { return with_value(good_file(), entry_field(1, 16), std::uint32_t(3)); }},
        {Issue::wrong_scheme, [] { return with_value(good_file(), entry_field(0, 16), std::uint32_t(1)); }},
        {Issue::wrong_scheme, [] { return with_value(good_file(), entry_field(1, 16), std::uint32_t(2)); }},
        {Issue::lengths_disagree,
         [] { return with_value(good_file(), entry_field(2, 48), std::uint64_t(51)); }},
        {Issue::impossible_ratio,
         [] {
             return edited([](FileParts& f) {
                 SectionEntry& entry = f.find(type_depth).entry;
                 entry.scheme = Scheme::zstd;
                 entry.raw_length = 32768 * 51;
             });
         }},
        {Issue::parts_not_first,
         [] { return edited([](FileParts& f) { std::swap(f.sections[0], f.sections[1]); }); }},
        {Issue::parts_not_first, [] { return edited([](FileParts& f) { f.sections.clear(); }); }},
        {Issue::duplicate_section,
         [] { return edited([](FileParts& f) { f.sections.push_back(f.find(type_depth)); }); }},
        {Issue::duplicate_section,
         [] { return edited([](FileParts& f) { f.sections.push_back(f.sections[0]); }); }},
        {Issue::fields_not_zero,
         [] { return with_value(good_file(), entry_field(1, 12), std::uint16_t(1)); }},
        {Issue::no_such_surface, [] { return with_value(good_file(), entry_field(2, 8), std::uint32_t(1)); }},
        {Issue::no_such_surface,
         [] { return with_value(good_file(), entry_field(2, 12), std::uint16_t(2)); }},
        {Issue::no_such_surface,
         [] { return with_value(good_file(), entry_field(2, 14), std::uint16_t(2)); }},
        {Issue::wrong_element_format,
         [] { return with_value(good_file(), entry_field(2, 20), std::uint32_t(1)); }},
        {Issue::wrong_element_format,
         [] { return with_value(good_file(), entry_field(2, 20), std::uint32_t(8)); }},
        {Issue::image_size_not_valid,
         [] {
             return edited([](FileParts& f) {
                 SectionEntry& entry = f.find(type_depth).entry;
                 entry.width = 25;
                 entry.height = 1;
             });
         }},
        {Issue::image_size_not_valid,
         [] { return with_value(good_file(), entry_field(2, 24), std::uint32_t(0)); }},
        {Issue::wrong_raw_length,
         [] { return with_value(good_file(), entry_field(2, 24), std::uint32_t(7)); }},
        {Issue::image_missing,
         [] { return edited([](FileParts& f) { f.sections.erase(f.sections.begin() + 3); }); }},
        {Issue::image_missing, [] { return with_part_value(108, std::uint32_t(3)); }},
        {Issue::depth_images_differ,
         [] {
             return edited([](FileParts& f) {
                 Section& section = f.find(type_depth, 0, 1);
                 section.entry.width = section.entry.height = 3;
                 section.stored.resize(18);
                 section.entry.raw_length = 18;
             });
         }},

        {Issue::wrong_parts_length,
         [] {
             return edited([](FileParts& f) {
                 f.sections[0].stored.push_back({});
                 f.sections[0].entry.raw_length = 193;
             });
         }},
        {Issue::wrong_parts_length,
         [] {
             return edited([](FileParts& f) {
                 f.sections[0].stored.clear();
                 f.sections[0].entry.raw_length = 0;
             });
         }},
        {Issue::part_number_not_valid,
         [] { return with_part_value(0, std::numeric_limits<double>::quiet_NaN()); }},
        {Issue::part_number_not_valid, [] { return with_part_value(24, 0.0); }},
        {Issue::part_number_not_valid,
         [] { return with_part_value(96, std::numeric_limits<double>::infinity()); }},
        {Issue::part_number_not_valid, [] { return with_part_value(24, 1e300); }},
        {Issue::frame_not_invertible, [] { return with_part_value(96, 1e-300); }},
        {Issue::frame_not_invertible, [] { return with_part_value(96, 0.0); }},
        {Issue::unknown_mapping, [] { return with_part_value(104, std::uint32_t(3)); }},
        {Issue::no_layers, [] { return with_part_value(108, std::uint32_t(0)); }},
        {Issue::no_layers, [] { return with_part_value(108, std::uint32_t(65536)); }},
        {Issue::index_not_valid, [] { return with_part_value(112, std::int32_t(-2)); }},
        {Issue::index_not_valid, [] { return with_part_value(116, std::int32_t(-2)); }},
        {Issue::error_figure_not_valid, [] { return with_part_value(120, -1.0F); }},
        {Issue::error_figure_not_valid,
         [] { return with_part_value(148, std::numeric_limits<float>::infinity()); }},
        {Issue::part_reserved_not_zero, [] { return with_part_value(191, std::uint8_t(1)); }},

        {Issue::padding_not_zero,
         [] {
             FileBytes file = good_file();
             file[std::size_t(take_apart(file).sections[2].entry.offset) - 1] = std::byte{1};
             return file;
         }},
        {Issue::checksum_mismatch,
         [] {
             FileBytes file = good_file();
             file.back() ^= std::byte{1};
             return file;
         }},
        {Issue::compressed_data_damaged,
         [] {
             // The header of a frame of this size has 6 bytes; 3 is the reserved type of the block after it.
             return edited([](FileParts& f) { f.find(type_depth).stored[6] |= std::byte{6}; },
                           compressed_file(Scheme::zstd));
         }},
        {Issue::compressed_data_damaged,
         [] {
             return edited([](FileParts& f) {
                 // Literals and sequences that make no sense, in a block of the right length.
                 Section& section = f.find(type_color);
                 section.entry.scheme = Scheme::zstd;
                 section.stored = compress(FileBytes(section.stored.size(), std::byte{7}), 1);
                 section.stored.back() ^= std::byte{0xFF};
             });
         }},
        {Issue::wrong_frame_size,
         [] {
             return edited([](FileParts& f) { f.find(type_depth).stored.push_back({}); },
                           compressed_file(Scheme::zstd));
         }},
        {Issue::wrong_frame_size,
         [] {
             return edited(
                 [](FileParts& f) { f.find(type_depth).stored = compress(f.find(type_color).stored, 1); },
                 compressed_file(Scheme::filtered_zstd));
         }},

        {Issue::depth_not_valid, [] { return with_f32_depth(std::numeric_limits<float>::quiet_NaN()); }},
        {Issue::depth_not_valid, [] { return with_f32_depth(1.0000001F); }},
        {Issue::depth_not_valid, [] { return with_f32_depth(-0.0F); }},
        {Issue::depth_not_valid, [] { return with_f32_depth(1e-40F); }},
        {Issue::interval_inside_out,
         [] {
             return edited([](FileParts& f) {
                 store(f.find(type_depth, 0, 0, Side::inner).stored.data() + 24, std::uint16_t(65535));
             });
         }},
        {Issue::layers_out_of_order,
         [] {
             return edited([](FileParts& f) {
                 store(f.find(type_depth, 0, 1).stored.data() + 24, std::uint16_t(65535));
             });
         }},
        {Issue::normal_not_valid,
         [] {
             return edited(
                 [](FileParts& f) { store(f.find(type_normal).stored.data() + 6, std::int16_t(-32768)); });
         }},
        {Issue::border_differs,
         [] {
             return edited(
                 [](FileParts& f) { store(f.find(type_depth).stored.data() + 2, std::uint16_t(65535)); });
         }},

        {Issue::metadata_not_utf8, [] { return with_metadata("{\"a\":\"\xC0\xAF\"}"); }},
        {Issue::metadata_not_json, [] { return with_metadata("[]"); }},
    };
    return fixtures;
}

// The same for limits: what is set, and the issue.
const std::map<Issue, Limits>& limit_fixtures() {
    static const std::map<Issue, Limits> fixtures{
        {Issue::too_many_bytes, {.file_bytes = 1000}},
        {Issue::too_many_sections, {.sections = 7}},
        {Issue::too_many_parts, {.parts = 0}},
        {Issue::too_many_layers, {.layers = 1}},
        {Issue::too_many_samples, {.image_samples = 24}},
        {Issue::too_many_raw_bytes, {.raw_bytes = 1000}},
        {Issue::too_much_metadata, {.metadata_bytes = 10}},
    };
    return fixtures;
}

TEST(Issues, TheGoodFileIsGood) {
    const Status status = check(good_file());
    EXPECT_TRUE(status.ok()) << describe(status, "file");
    EXPECT_TRUE(check(compressed_file(Scheme::zstd)).ok());
    EXPECT_TRUE(check(write(make_map({f32_part()}).map)).ok());
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

std::string specification() {
    std::ifstream stream(SPA_SPECIFICATION);
    std::stringstream text;
    text << stream.rdbuf();
    return text.str();
}

TEST(Issues, TableIsThatOfTheSpecification) {
    std::istringstream text(specification());
    std::vector<std::string> rows;
    for (std::string line; std::getline(text, line);)
        if (line.rfind("| SPA-", 0) == 0) rows.push_back(line);
    ASSERT_EQ(rows.size(), issue_table.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const IssueEntry& entry = issue_table[i];
        EXPECT_EQ(rows[i], "| " + number(entry.issue) + " | " + std::string(entry.name) + " | " +
                               std::string(entry.text) + " |");
    }
}

TEST(Issues, SpecificationMentionsEveryRuleOfAFile) {
    const std::string text = specification();
    const std::string rules = text.substr(0, text.find("## 12."));
    for (const IssueEntry& entry : issue_table) {
        if (entry.issue >= Issue::out_of_memory) continue;
        bool found = rules.find(number(entry.issue)) != std::string::npos;
        // "SPA-302 to SPA-308"
        if (entry.issue > Issue::part_number_not_valid && entry.issue < Issue::part_reserved_not_zero)
            found = true;
        EXPECT_TRUE(found) << number(entry.issue);
    }
}

// The dump of section 13: "offset  16 bytes in hexadecimal".
TEST(Issues, ExampleOfTheSpecificationIsWhatTheWriterWrites) {
    const FileBytes file = write(make_example().map);
    std::ostringstream dump;
    dump << std::hex << std::uppercase;
    for (std::size_t i = 0; i < file.size(); ++i) {
        if (i % 16 == 0)
            dump << (i == 0 ? "" : "\n") << "0x" << (i < 256 ? "0" : "") << (i < 16 ? "0" : "") << i << " ";
        const unsigned value = std::to_integer<unsigned>(file[i]);
        dump << " " << (value < 16 ? "0" : "") << value;
    }
    EXPECT_NE(specification().find("```\n" + dump.str() + "\n```"), std::string::npos) << dump.str();
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
        edited([](FileParts& f) { std::reverse(f.sections.begin() + 1, f.sections.end()); });
    File opened;
    ASSERT_TRUE(open(std::span<const std::byte>(file), opened).ok());
    EXPECT_TRUE(same(opened.map(), make_map({TestPart{}}).map));
}

TEST(Versions, NewerMinorIsReadWithWhatItReserves) {
    FileBytes file = with_unknown_section(0xF0, 1);
    EXPECT_TRUE(check(file).ok());
    EXPECT_TRUE(check(with_value(file, 30, std::uint8_t(1))).ok());
    const FileBytes reserved = edited(
        [](FileParts& f) {
            f.sections[0].stored[191] = std::byte{1};
            f.sections[2].entry.flags |= 4U;
        },
        file);
    const Status status = check(reserved);
    EXPECT_TRUE(status.ok()) << describe(status, "file");
    EXPECT_EQ(check(with_unknown_section(flag_required, 9)).issue, Issue::unknown_required_section);
}

} // namespace
} // namespace spa::test
