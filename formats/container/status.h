// SPDX-License-Identifier: Apache-2.0
// Everything that can be wrong with a `.spa` file, or with reading and writing one: one numbered table. The
// numbers, names and texts are those of ../SPA.md, "Issues"; they never change meaning.
#pragma once

#include "../../libspa/core/error.h"

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace spa::container {

// The numeric value is the number of the issue: SPA-101, ...
enum class Issue : std::uint16_t {
    none = 0,

    file_too_short = 101,
    not_a_spa_file = 102,
    identifier_damaged = 103,
    version_not_supported = 104,
    file_truncated = 105,
    file_too_long = 106,
    table_outside_file = 107,
    table_checksum_mismatch = 108,
    header_reserved_not_zero = 109,

    unknown_required_section = 201,
    unknown_flags = 202,
    wrong_required_flag = 203,
    section_not_aligned = 204,
    sections_overlap = 205,
    gap_between_sections = 206,
    section_outside_file = 207,
    bytes_after_last_section = 208,
    unknown_scheme = 209,
    wrong_scheme = 210,
    lengths_disagree = 211,
    impossible_ratio = 212,
    parts_not_first = 213,
    duplicate_section = 214,
    fields_not_zero = 215,
    no_such_surface = 216,
    wrong_element_format = 217,
    image_size_not_valid = 218,
    wrong_raw_length = 219,
    image_missing = 220,
    depth_images_differ = 221,
    mixed_fields_not_zero = 222,
    mixed_part_not_valid = 223,
    wrong_mixed_length = 224,
    fold_fields_not_zero = 225,
    fold_part_not_valid = 226,
    wrong_fold_length = 227,
    bind_fields_not_zero = 228,
    bind_part_not_valid = 229,
    wrong_bind_length = 230,

    wrong_parts_length = 301,
    part_number_not_valid = 302,
    frame_not_invertible = 303,
    unknown_mapping = 304,
    no_layers = 305,
    index_not_valid = 306,
    error_figure_not_valid = 307,
    part_reserved_not_zero = 308,
    unknown_part_flags = 309,
    bind_not_valid = 310,

    padding_not_zero = 401,
    checksum_mismatch = 402,
    compressed_data_damaged = 403,
    wrong_frame_size = 404,

    depth_not_valid = 501,
    interval_inside_out = 502,
    layers_out_of_order = 503,
    normal_not_valid = 504,
    border_differs = 505,
    corners_differ = 506,
    fold_edge_not_valid = 507,
    fold_index_not_valid = 508,
    fold_cut_not_valid = 509,
    fold_on_pure_triangle = 510,

    metadata_not_utf8 = 601,
    metadata_not_json = 602,

    too_many_bytes = 701,
    too_many_sections = 702,
    too_many_parts = 703,
    too_many_layers = 704,
    too_many_samples = 705,
    too_many_raw_bytes = 706,
    too_much_metadata = 707,
    out_of_memory = 708,

    cannot_open = 801,
    cannot_read = 802,
    cannot_write = 803,
    image_view_not_valid = 804,
};

struct IssueEntry {
    Issue issue;
    std::string_view name;
    std::string_view text;   // what is wrong
    std::string_view advice; // what to do
};

extern const std::array<IssueEntry, 77> issue_table;

constexpr std::uint32_t no_section = 0xFFFFFFFF;

// The outcome of anything that reads or writes a `.spa` file.
struct Status {
    Issue issue = Issue::none;
    std::uint32_t section = no_section; // index into the section table
    std::uint64_t offset = 0;           // byte in the file, or with `decoded` in the section's decoded data
    bool decoded = false;
    // What the section is, if it is one.
    std::uint32_t type = 0, part = 0;
    std::uint16_t layer = 0, side = 0;
    int system_error = 0; // errno of cannot_open, cannot_read and cannot_write

    [[nodiscard]] bool ok() const { return issue == Issue::none; }
};

// "SPA-101"
std::string number(Issue issue);

// The entry of an issue; nullptr for none.
const IssueEntry* find(Issue issue);

// One line for a person: the file, what is wrong, where, what to do. Empty for a status that is ok.
std::string describe(const Status& status, std::string_view file_name);

// The exit code of the command: input_output for 801 to 803, unsupported for a newer version or an unknown
// required section, internal for out_of_memory and image_view_not_valid, ok for none, else invalid_data.
ExitCode exit_code(Issue issue);

} // namespace spa::container
