// SPDX-License-Identifier: Apache-2.0
#include "status.h"

#include "format.h"

#include <algorithm>
#include <system_error>

namespace spa::container {
namespace {

constexpr std::string_view again = "The file is damaged: fetch it again or bake it again.";
constexpr std::string_view writer =
    "The program that wrote the file is at fault: write it again with a newer one.";
constexpr std::string_view raise = "If you trust the file, raise the limit.";

// "DPTH of part 0, layer 1, inner"; other sections by type alone.
std::string section_name(const Status& status) {
    std::string text = type_name(status.type);
    if (status.type == type_mixed || status.type == type_fold)
        return text + " of part " + std::to_string(status.part);
    if (!is_image(status.type)) return text;
    text += " of part " + std::to_string(status.part) + ", layer " + std::to_string(status.layer);
    if (status.side <= std::uint16_t(Side::inner))
        text += status.side == std::uint16_t(Side::outer) ? ", outer" : ", inner";
    return text;
}

} // namespace

// Ascending. Names and texts are those of SPA.md, letter for letter: a test compares.
const std::array<IssueEntry, 77> issue_table{{
    {Issue::file_too_short, "file_too_short", "the file is shorter than a header", again},
    {Issue::not_a_spa_file, "not_a_spa_file", "the file does not begin with the identifier",
     "This is another kind of file."},
    {Issue::identifier_damaged, "identifier_damaged", "the identifier was changed by a transfer in text mode",
     "Transfer the file in binary mode."},
    {Issue::version_not_supported, "version_not_supported", "the major version is not 1",
     "Read it with a newer spa, or bake it again with this one."},
    {Issue::file_truncated, "file_truncated", "the file ends before the length in its header",
     "The file was cut off: fetch it again or bake it again."},
    {Issue::file_too_long, "file_too_long", "the file goes on after the length in its header", again},
    {Issue::table_outside_file, "table_outside_file", "the section table does not fit into the file", again},
    {Issue::table_checksum_mismatch, "table_checksum_mismatch",
     "header and section table do not have their checksum", again},
    {Issue::header_reserved_not_zero, "header_reserved_not_zero", "a reserved byte of the header is not zero",
     writer},

    {Issue::unknown_required_section, "unknown_required_section",
     "a section of unknown type is marked as required", "Read it with a newer spa."},
    {Issue::unknown_flags, "unknown_flags", "an undefined flag of a section is set", writer},
    {Issue::wrong_required_flag, "wrong_required_flag",
     "the required flag is not the one that the section's type prescribes", writer},
    {Issue::section_not_aligned, "section_not_aligned", "the offset of a section is not a multiple of 64",
     writer},
    {Issue::sections_overlap, "sections_overlap",
     "a section begins before the end of the one before it, or of the table", writer},
    {Issue::gap_between_sections, "gap_between_sections",
     "a section begins later than at the first multiple of 64 after the one before it", writer},
    {Issue::section_outside_file, "section_outside_file", "a section goes on after the end of the file",
     writer},
    {Issue::bytes_after_last_section, "bytes_after_last_section",
     "the file goes on after the end of its last section", writer},
    {Issue::unknown_scheme, "unknown_scheme", "the scheme of a section is not defined", writer},
    {Issue::wrong_scheme, "wrong_scheme", "the section's type does not allow this scheme", writer},
    {Issue::lengths_disagree, "lengths_disagree", "a section without compression has two different lengths",
     writer},
    {Issue::impossible_ratio, "impossible_ratio",
     "a section claims to hold more than 32768 times its stored length", writer},
    {Issue::parts_not_first, "parts_not_first", "the first section is not PART", writer},
    {Issue::duplicate_section, "duplicate_section", "two sections have the same type, part, layer and side",
     writer},
    {Issue::fields_not_zero, "fields_not_zero",
     "a PART or META section has part, layer, side, element format, width or height", writer},
    {Issue::no_such_surface, "no_such_surface", "an image names a part, layer or side that does not exist",
     writer},
    {Issue::wrong_element_format, "wrong_element_format",
     "the element format is not one of those of the section's type", writer},
    {Issue::image_size_not_valid, "image_size_not_valid", "the mapping does not allow an image of this size",
     writer},
    {Issue::wrong_raw_length, "wrong_raw_length", "the raw length is not that of the image", writer},
    {Issue::image_missing, "image_missing", "an image that must be there is missing", writer},
    {Issue::depth_images_differ, "depth_images_differ",
     "the depth images of a part differ in size or element format", writer},
    {Issue::mixed_fields_not_zero, "mixed_fields_not_zero",
     "a MIXD section has layer, side, element format, width or height", writer},
    {Issue::mixed_part_not_valid, "mixed_part_not_valid",
     "a MIXD section names a part that does not exist or is not octahedral", writer},
    {Issue::wrong_mixed_length, "wrong_mixed_length",
     "the raw length of a MIXD section is not that of its part's map", writer},
    {Issue::fold_fields_not_zero, "fold_fields_not_zero",
     "a FOLD section has layer, side, element format, width or height", writer},
    {Issue::fold_part_not_valid, "fold_part_not_valid",
     "a FOLD section names a part that does not exist, is not octahedral, has no MIXD or more than 16384 "
     "cells a side",
     writer},
    {Issue::wrong_fold_length, "wrong_fold_length",
     "the raw length of a FOLD section is zero, not a multiple of 10 or too large for its part's map",
     writer},
    {Issue::bind_fields_not_zero, "bind_fields_not_zero",
     "a BIND section has layer, side, element format, width or height", writer},
    {Issue::bind_part_not_valid, "bind_part_not_valid",
     "a BIND section names a part that does not exist or follows no node", writer},
    {Issue::wrong_bind_length, "wrong_bind_length", "the raw length of a BIND section is not 96", writer},

    {Issue::wrong_parts_length, "wrong_parts_length", "the length of PART is zero or not a multiple of 192",
     writer},
    {Issue::part_number_not_valid, "part_number_not_valid",
     "centre, radius or frame has a number that is not finite or out of range", writer},
    {Issue::frame_not_invertible, "frame_not_invertible", "the frame of a part cannot be inverted", writer},
    {Issue::unknown_mapping, "unknown_mapping", "the mapping of a part is not defined", writer},
    {Issue::no_layers, "no_layers", "a part has no layers or more than 65535", writer},
    {Issue::index_not_valid, "index_not_valid", "a node or joint index is less than -1", writer},
    {Issue::error_figure_not_valid, "error_figure_not_valid", "an error figure is negative or infinite",
     writer},
    {Issue::part_reserved_not_zero, "part_reserved_not_zero", "a reserved byte of a part is not zero",
     writer},
    {Issue::unknown_part_flags, "unknown_part_flags", "an undefined flag of a part is set", writer},
    {Issue::bind_not_valid, "bind_not_valid",
     "the matrix of a BIND section has a number that is not finite or out of range, or cannot be inverted",
     writer},

    {Issue::padding_not_zero, "padding_not_zero", "a byte of padding is not zero", again},
    {Issue::checksum_mismatch, "checksum_mismatch", "the stored bytes do not have their checksum", again},
    {Issue::compressed_data_damaged, "compressed_data_damaged", "the stored bytes cannot be decompressed",
     writer},
    {Issue::wrong_frame_size, "wrong_frame_size",
     "the stored bytes are not one Zstandard frame that states the raw length", writer},

    {Issue::depth_not_valid, "depth_not_valid", "a depth is not zero and not a normal number in (0, 1]",
     writer},
    {Issue::interval_inside_out, "interval_inside_out",
     "an inner depth is larger than the outer depth of its layer", writer},
    {Issue::layers_out_of_order, "layers_out_of_order",
     "an outer depth is larger than the inner depth of the layer before it", writer},
    {Issue::normal_not_valid, "normal_not_valid", "a normal has the code -128 or -32768", writer},
    {Issue::border_differs, "border_differs",
     "two depths of an octahedral border that are the same point differ", writer},
    {Issue::corners_differ, "corners_differ",
     "a triangle that is not mixed has corners with different numbers of surfaces", writer},
    {Issue::fold_edge_not_valid, "fold_edge_not_valid",
     "a fold record names an edge that does not exist, or one before that of the record before it", writer},
    {Issue::fold_index_not_valid, "fold_index_not_valid",
     "a fold record names a crossing that is not there at its end of the edge", writer},
    {Issue::fold_cut_not_valid, "fold_cut_not_valid",
     "a fold record has a depth of 0 at its cut, or one that is not 0 for a crossing that it does not have",
     writer},
    {Issue::fold_on_pure_triangle, "fold_on_pure_triangle",
     "a fold record names an edge of a triangle that is not mixed", writer},

    {Issue::metadata_not_utf8, "metadata_not_utf8", "the metadata is not valid UTF-8", writer},
    {Issue::metadata_not_json, "metadata_not_json",
     "the metadata is not one JSON object nested at most 64 deep", writer},

    {Issue::too_many_bytes, "too_many_bytes", "the file is longer than the limit allows", raise},
    {Issue::too_many_sections, "too_many_sections", "there are more sections than the limit allows", raise},
    {Issue::too_many_parts, "too_many_parts", "there are more parts than the limit allows", raise},
    {Issue::too_many_layers, "too_many_layers", "a part has more layers than the limit allows", raise},
    {Issue::too_many_samples, "too_many_samples", "an image has more samples than the limit allows", raise},
    {Issue::too_many_raw_bytes, "too_many_raw_bytes",
     "the decoded sections have more bytes than the limit allows", raise},
    {Issue::too_much_metadata, "too_much_metadata", "the metadata is longer than the limit allows", raise},
    {Issue::out_of_memory, "out_of_memory", "there is not enough memory",
     "Close other programs or lower the limits."},

    {Issue::cannot_open, "cannot_open", "the file cannot be opened", "Check the path and the permissions."},
    {Issue::cannot_read, "cannot_read", "the file cannot be read", "Check the disk or the connection."},
    {Issue::cannot_write, "cannot_write", "the file cannot be written",
     "Check the folder, its permissions and the free space; nothing was left behind."},
    {Issue::image_view_not_valid, "image_view_not_valid",
     "an image to be written has not the bytes that its size and element format need",
     "The program that made the image is at fault."},
}};

std::string number(Issue issue) { return "SPA-" + std::to_string(unsigned(issue)); }

const IssueEntry* find(Issue issue) {
    const auto entry = std::find_if(issue_table.begin(), issue_table.end(),
                                    [issue](const IssueEntry& e) { return e.issue == issue; });
    return entry == issue_table.end() ? nullptr : &*entry;
}

std::string describe(const Status& status, std::string_view file_name) {
    const IssueEntry* entry = find(status.issue);
    if (entry == nullptr) return {};
    std::string text(file_name);
    text += ": " + number(status.issue) + ": " + std::string(entry->text);
    if (status.system_error != 0) text += " (" + std::generic_category().message(status.system_error) + ")";
    if (status.section != no_section) {
        text += ", in section " + std::to_string(status.section) + " (" + section_name(status) + ")";
    } else if (status.type != 0) {
        text += ", " + section_name(status);
    }
    const bool has_offset = status.issue < Issue::cannot_open && status.issue != Issue::out_of_memory;
    if (has_offset) {
        text += ", byte " + std::to_string(status.offset);
        text += status.decoded ? " of the decoded section" : " of the file";
    }
    return text + ". " + std::string(entry->advice);
}

ExitCode exit_code(Issue issue) {
    switch (issue) {
    case Issue::none: return ExitCode::ok;
    case Issue::cannot_open:
    case Issue::cannot_read:
    case Issue::cannot_write: return ExitCode::input_output;
    case Issue::version_not_supported:
    case Issue::unknown_required_section: return ExitCode::unsupported;
    case Issue::out_of_memory:
    case Issue::image_view_not_valid: return ExitCode::internal;
    default: return ExitCode::invalid_data;
    }
}

} // namespace spa::container
