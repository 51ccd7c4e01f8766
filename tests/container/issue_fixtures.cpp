// SPDX-License-Identifier: Apache-2.0
#include "issue_fixtures.h"

#include "test_maps.h"

#include "../../formats/container/codec.h"

#include <algorithm>
#include <limits>

namespace spa::test {

using namespace spa::container;

namespace {

// A valid file with a value at an offset of the first part's record.
template <class T>
FileBytes with_part_value(std::size_t offset, T value) {
    return edited(good_file(), [&](FileParts& f) { store(f.sections[0].stored.data() + offset, value); });
}

FileBytes with_mixed_value(std::size_t field, std::uint32_t value) {
    return with_entry_value(type_mixed, field, value);
}

FileBytes bytes_of(std::string_view text) {
    FileBytes bytes(text.size());
    std::transform(text.begin(), text.end(), bytes.begin(), [](char c) { return std::byte(c); });
    return bytes;
}

FileBytes with_metadata(std::string_view text) {
    return edited(good_file(), [&](FileParts& f) {
        Section& section = f.find(type_metadata);
        section.stored = bytes_of(text);
        section.entry.raw_length = text.size();
    });
}

// Two parts of which the second follows a node; its BIND is the last section.
FileBytes file_with_bind() { return write(make_map({TestPart{}, TestPart{}}).map); }

FileBytes with_bind_entry(std::size_t field, std::uint32_t value) {
    const FileBytes file = file_with_bind();
    return with_value(file, entry_field(take_apart(file).sections.size() - 1, field), value);
}

FileBytes with_bind_value(std::size_t offset, double value) {
    return edited(file_with_bind(),
                  [&](FileParts& f) { store(f.sections.back().stored.data() + offset, value); });
}

TestPart f32_part() {
    TestPart part;
    part.depth = ElementFormat::f32;
    return part;
}

} // namespace

FileBytes good_file() { return write(make_map({TestPart{}}).map); }

FileBytes with_entry_value(std::uint32_t type, std::size_t field, std::uint32_t value) {
    const FileParts parts = take_apart(good_file());
    const auto at = std::find_if(parts.sections.begin(), parts.sections.end(),
                                 [type](const Section& s) { return s.entry.type == type; });
    return with_value(good_file(), entry_field(std::size_t(at - parts.sections.begin()), field), value);
}

FileBytes compressed_file(Scheme scheme) {
    return edited(good_file(), [&](FileParts& f) {
        Section& section = f.find(type_depth);
        section.entry.scheme = scheme;
        section.stored = compress(section.stored, 1);
    });
}

FileBytes with_unknown_section(std::uint32_t flags, std::uint16_t minor) {
    return edited(good_file(), [&](FileParts& f) {
        Section section;
        section.entry.type = section_type("XTRA");
        section.entry.flags = flags;
        section.entry.scheme = Scheme(77);
        section.entry.raw_length = UINT64_MAX;
        section.stored = bytes_of("anything");
        f.sections.push_back(section);
        f.minor = minor;
    });
}

FileBytes with_f32_depth(float value) {
    return edited(write(make_map({f32_part()}).map),
                  [&](FileParts& f) { store(f.find(type_depth).stored.data() + 4 * 12, value); });
}

Fixtures file_fixtures() {
    Fixtures fixtures{
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
             return edited(good_file(), [](FileParts& f) {
                 SectionEntry& entry = f.find(type_depth).entry;
                 entry.scheme = Scheme::zstd;
                 entry.raw_length = 32768 * 51;
             });
         }},
        {Issue::parts_not_first,
         [] { return edited(good_file(), [](FileParts& f) { std::swap(f.sections[0], f.sections[1]); }); }},
        {Issue::parts_not_first,
         [] { return edited(good_file(), [](FileParts& f) { f.sections.clear(); }); }},
        {Issue::duplicate_section,
         [] { return edited(good_file(), [](FileParts& f) { f.sections.push_back(f.find(type_depth)); }); }},
        {Issue::duplicate_section,
         [] { return edited(good_file(), [](FileParts& f) { f.sections.push_back(f.sections[0]); }); }},
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
             return edited(good_file(), [](FileParts& f) {
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
         [] { return edited(good_file(), [](FileParts& f) { f.sections.erase(f.sections.begin() + 3); }); }},
        {Issue::image_missing, [] { return with_part_value(108, std::uint32_t(3)); }},
        {Issue::depth_images_differ,
         [] {
             return edited(good_file(), [](FileParts& f) {
                 Section& section = f.find(type_depth, 0, 1);
                 section.entry.width = section.entry.height = 3;
                 section.stored.resize(18);
                 section.entry.raw_length = 18;
             });
         }},

        {Issue::wrong_required_flag, [] { return with_mixed_value(4, flag_required); }},
        {Issue::wrong_scheme, [] { return with_mixed_value(16, 2); }},
        {Issue::duplicate_section,
         [] { return edited(good_file(), [](FileParts& f) { f.sections.push_back(f.find(type_mixed)); }); }},
        {Issue::mixed_fields_not_zero, [] { return with_mixed_value(12, 1); }},
        {Issue::mixed_fields_not_zero, [] { return with_mixed_value(12, 0x10000); }},
        {Issue::mixed_fields_not_zero, [] { return with_mixed_value(20, 2); }},
        {Issue::mixed_fields_not_zero, [] { return with_mixed_value(24, 5); }},
        {Issue::mixed_fields_not_zero, [] { return with_mixed_value(28, 5); }},
        {Issue::mixed_part_not_valid, [] { return with_mixed_value(8, 1); }},
        {Issue::mixed_part_not_valid,
         [] {
             // Any size suits a lat-long map.
             return with_part_value(104, std::uint32_t(Mapping::latlong));
         }},
        {Issue::wrong_mixed_length,
         [] {
             return edited(good_file(), [](FileParts& f) {
                 Section& section = f.find(type_mixed);
                 section.stored.push_back({});
                 section.entry.raw_length = section.stored.size();
             });
         }},
        {Issue::wrong_mixed_length,
         [] {
             return edited(good_file(), [](FileParts& f) {
                 Section& section = f.find(type_mixed);
                 section.stored.clear();
                 section.entry.raw_length = 0;
             });
         }},

        {Issue::wrong_parts_length,
         [] {
             return edited(good_file(), [](FileParts& f) {
                 f.sections[0].stored.push_back({});
                 f.sections[0].entry.raw_length = 193;
             });
         }},
        {Issue::wrong_parts_length,
         [] {
             return edited(good_file(), [](FileParts& f) {
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
        {Issue::part_reserved_not_zero, [] { return with_part_value(156, std::uint8_t(1)); }},
        {Issue::part_reserved_not_zero,
         [] { return edited(good_file(), [](FileParts& f) { f.minor = 0; }); }},
        {Issue::unknown_part_flags, [] { return with_part_value(152, std::uint32_t(2)); }},
        {Issue::unknown_part_flags, [] { return with_part_value(152, std::uint32_t(0x80000001)); }},

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
             return edited(compressed_file(Scheme::zstd),
                           [](FileParts& f) { f.find(type_depth).stored[6] |= std::byte{6}; });
         }},
        {Issue::compressed_data_damaged,
         [] {
             return edited(good_file(), [](FileParts& f) {
                 // Literals and sequences that make no sense, in a block of the right length.
                 Section& section = f.find(type_color);
                 section.entry.scheme = Scheme::zstd;
                 section.stored = compress(FileBytes(section.stored.size(), std::byte{7}), 1);
                 section.stored.back() ^= std::byte{0xFF};
             });
         }},
        {Issue::wrong_frame_size,
         [] {
             return edited(compressed_file(Scheme::zstd),
                           [](FileParts& f) { f.find(type_depth).stored.push_back({}); });
         }},
        {Issue::wrong_frame_size,
         [] {
             return edited(compressed_file(Scheme::filtered_zstd), [](FileParts& f) {
                 f.find(type_depth).stored = compress(f.find(type_color).stored, 1);
             });
         }},

        {Issue::depth_not_valid, [] { return with_f32_depth(std::numeric_limits<float>::quiet_NaN()); }},
        {Issue::depth_not_valid, [] { return with_f32_depth(1.0000001F); }},
        {Issue::depth_not_valid, [] { return with_f32_depth(-0.0F); }},
        {Issue::depth_not_valid, [] { return with_f32_depth(1e-40F); }},
        {Issue::interval_inside_out,
         [] {
             return edited(good_file(), [](FileParts& f) {
                 store(f.find(type_depth, 0, 0, Side::inner).stored.data() + 24, std::uint16_t(65535));
             });
         }},
        {Issue::layers_out_of_order,
         [] {
             return edited(good_file(), [](FileParts& f) {
                 store(f.find(type_depth, 0, 1).stored.data() + 24, std::uint16_t(65535));
             });
         }},
        {Issue::normal_not_valid,
         [] {
             return edited(good_file(), [](FileParts& f) {
                 store(f.find(type_normal).stored.data() + 6, std::int16_t(-32768));
             });
         }},
        {Issue::border_differs,
         [] {
             return edited(good_file(), [](FileParts& f) {
                 store(f.find(type_depth).stored.data() + 2, std::uint16_t(65535));
             });
         }},
        {Issue::corners_differ,
         [] {
             // A hole in the middle of which the bits say nothing.
             return edited(good_file(), [](FileParts& f) {
                 for (Section& section : f.sections)
                     if (section.entry.type == type_depth)
                         store(section.stored.data() + 24, std::uint16_t(0));
                 FileBytes& bits = f.find(type_mixed).stored;
                 std::fill(bits.begin(), bits.end(), std::byte{});
             });
         }},

        {Issue::wrong_required_flag, [] { return with_bind_entry(4, flag_required); }},
        {Issue::duplicate_section,
         [] {
             return edited(file_with_bind(), [](FileParts& f) { f.sections.push_back(f.sections.back()); });
         }},
        {Issue::bind_fields_not_zero, [] { return with_bind_entry(12, 1); }},
        {Issue::bind_fields_not_zero, [] { return with_bind_entry(20, 2); }},
        {Issue::bind_fields_not_zero, [] { return with_bind_entry(24, 5); }},
        {Issue::bind_part_not_valid, [] { return with_bind_entry(8, 0); }},
        {Issue::bind_part_not_valid, [] { return with_bind_entry(8, 2); }},
        {Issue::wrong_bind_length, [] { return with_bind_entry(48, 88); }},
        {Issue::bind_not_valid, [] { return with_bind_value(0, std::numeric_limits<double>::quiet_NaN()); }},
        {Issue::bind_not_valid, [] { return with_bind_value(88, 0x1p61); }},
        {Issue::bind_not_valid,
         [] {
             return edited(file_with_bind(), [](FileParts& f) {
                 std::fill_n(f.sections.back().stored.begin(), 72, std::byte{});
             });
         }},

        {Issue::metadata_not_utf8, [] { return with_metadata("{\"a\":\"\xC0\xAF\"}"); }},
        {Issue::metadata_not_json, [] { return with_metadata("[]"); }},
    };
    fixtures.merge(fold_fixtures());
    return fixtures;
}

std::map<Issue, Limits> limit_fixtures() {
    return {
        {Issue::too_many_bytes, {.file_bytes = 1000}},
        {Issue::too_many_sections, {.sections = 7}},
        {Issue::too_many_parts, {.parts = 0}},
        {Issue::too_many_layers, {.layers = 1}},
        {Issue::too_many_samples, {.image_samples = 24}},
        {Issue::too_many_raw_bytes, {.raw_bytes = 1000}},
        {Issue::too_much_metadata, {.metadata_bytes = 10}},
    };
}

} // namespace spa::test
