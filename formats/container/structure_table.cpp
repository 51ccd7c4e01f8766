// SPDX-License-Identifier: Apache-2.0
#include "structure.h"

#include "checksum.h"

#include <algorithm>

namespace spa::container {
namespace {

// Offsets of the fields of a section entry, for messages.
enum class Field : std::uint8_t {
    type = 0,
    flags = 4,
    part = 8,
    layer = 12,
    scheme = 16,
    format = 20,
    width = 24,
    offset = 32,
    stored_length = 40,
    raw_length = 48
};

Status at_field(Issue issue, const Structure& structure, std::size_t index, Field field) {
    Status status = at_section(issue, structure, index);
    status.offset = header_size + index * section_entry_size + std::uint64_t(field);
    return status;
}

// The identifier as it comes out of the usual accidents: high bit cut off, CR LF turned into LF, LF into CR
// LF.
bool is_damaged_identifier(std::span<const std::byte> bytes) {
    constexpr std::array<char, 7> name{'S', 'P', 'A', ' ', 'M', 'a', 'p'};
    return std::equal(name.begin(), name.end(), bytes.begin() + 1,
                      [](char c, std::byte b) { return std::byte(c) == b; });
}

// A Zstandard block holds at most 128 KiB and takes at least 4 bytes.
constexpr std::uint64_t largest_ratio = 32768;

bool is_format_of(std::uint32_t type, ElementFormat format) {
    switch (format) {
    case ElementFormat::rgba8: return type == type_color;
    case ElementFormat::u8:
    case ElementFormat::u16:
    case ElementFormat::f32: return type == type_depth;
    case ElementFormat::oct8:
    case ElementFormat::oct16:
    case ElementFormat::rgb8: return type == type_normal;
    }
    return false;
}

Status check_image_entry(const Structure& structure, std::size_t i, const Limits& limits) {
    const SectionEntry& entry = structure.sections[i];
    if (!is_format_of(entry.type, entry.format))
        return at_field(Issue::wrong_element_format, structure, i, Field::format);
    if (entry.width == 0 || entry.height == 0)
        return at_field(Issue::image_size_not_valid, structure, i, Field::width);
    // Both factors are below 2^32, and so the product is exact; element sizes are at most 4.
    const std::uint64_t samples = std::uint64_t(entry.width) * entry.height;
    if (samples > limits.image_samples) return at_field(Issue::too_many_samples, structure, i, Field::width);
    if (samples > UINT64_MAX / 4 || entry.raw_length != samples * element_size(entry.format))
        return at_field(Issue::wrong_raw_length, structure, i, Field::raw_length);
    return {};
}

Status check_known_entry(const Structure& structure, std::size_t i, const Limits& limits) {
    const SectionEntry& entry = structure.sections[i];
    const bool required = (entry.flags & flag_required) != 0;
    if (required == is_optional(entry.type))
        return at_field(Issue::wrong_required_flag, structure, i, Field::flags);
    if (entry.scheme != Scheme::none && entry.scheme != Scheme::zstd && entry.scheme != Scheme::filtered_zstd)
        return at_field(Issue::unknown_scheme, structure, i, Field::scheme);
    if ((entry.type == type_part && entry.scheme != Scheme::none) ||
        (!is_image(entry.type) && entry.scheme == Scheme::filtered_zstd))
        return at_field(Issue::wrong_scheme, structure, i, Field::scheme);
    if (!is_image(entry.type)) {
        const bool only_part = entry.layer == 0 && entry.side == 0 && std::uint32_t(entry.format) == 0 &&
                               entry.width == 0 && entry.height == 0;
        const bool of_part = entry.type == type_mixed || entry.type == type_fold || entry.type == type_bind;
        if (of_part && !only_part)
            return at_field(entry.type == type_mixed  ? Issue::mixed_fields_not_zero
                            : entry.type == type_fold ? Issue::fold_fields_not_zero
                                                      : Issue::bind_fields_not_zero,
                            structure, i, Field::layer);
        if (!of_part && (!only_part || entry.part != 0))
            return at_field(Issue::fields_not_zero, structure, i, Field::part);
    }
    if (entry.type == type_bind && entry.raw_length != bind_size)
        return at_field(Issue::wrong_bind_length, structure, i, Field::raw_length);
    if (entry.scheme == Scheme::none && entry.raw_length != entry.stored_length)
        return at_field(Issue::lengths_disagree, structure, i, Field::raw_length);
    if (entry.raw_length / largest_ratio > entry.stored_length)
        return at_field(Issue::impossible_ratio, structure, i, Field::raw_length);
    if (entry.type == type_metadata && entry.raw_length > limits.metadata_bytes)
        return at_field(Issue::too_much_metadata, structure, i, Field::raw_length);
    return is_image(entry.type) ? check_image_entry(structure, i, limits) : Status{};
}

// Each section at the first aligned byte after the one before it: no overlap, no gap, nothing after the last.
Status check_places(const Structure& structure) {
    const std::uint64_t length = structure.header.file_length;
    std::uint64_t end = header_size + structure.sections.size() * section_entry_size;
    for (std::size_t i = 0; i < structure.sections.size(); ++i) {
        const SectionEntry& entry = structure.sections[i];
        if (entry.offset % section_alignment != 0)
            return at_field(Issue::section_not_aligned, structure, i, Field::offset);
        // Near 2^64 there is no aligned byte left, and align would wrap.
        if (end > UINT64_MAX - section_alignment)
            return at_field(Issue::section_outside_file, structure, i, Field::offset);
        if (entry.offset < align(end)) return at_field(Issue::sections_overlap, structure, i, Field::offset);
        if (entry.offset > align(end))
            return at_field(Issue::gap_between_sections, structure, i, Field::offset);
        if (entry.offset > length || entry.stored_length > length - entry.offset)
            return at_field(Issue::section_outside_file, structure, i, Field::stored_length);
        end = entry.offset + entry.stored_length;
    }
    return end == length ? Status{} : at_byte(Issue::bytes_after_last_section, end);
}

} // namespace

Status at_byte(Issue issue, std::uint64_t offset) {
    Status status;
    status.issue = issue;
    status.offset = offset;
    return status;
}

Status at_section(Issue issue, const Structure& structure, std::size_t index) {
    const SectionEntry& entry = structure.sections[index];
    Status status = at_byte(issue, entry.offset);
    status.section = std::uint32_t(index);
    status.type = entry.type;
    status.part = entry.part;
    status.layer = entry.layer;
    status.side = entry.side;
    return status;
}

Status in_section(Issue issue, const Structure& structure, std::size_t index, std::uint64_t offset) {
    Status status = at_section(issue, structure, index);
    status.offset = offset;
    status.decoded = true;
    return status;
}

Status check_identifier(std::span<const std::byte> bytes) {
    if (bytes.size() < identifier.size()) return at_byte(Issue::file_too_short, bytes.size());
    const bool same = std::equal(identifier.begin(), identifier.end(), bytes.begin(),
                                 [](std::uint8_t a, std::byte b) { return std::byte(a) == b; });
    if (same) return {};
    return at_byte(is_damaged_identifier(bytes) ? Issue::identifier_damaged : Issue::not_a_spa_file, 0);
}

Status check_header(std::span<const std::byte, header_size> bytes, const Limits& limits, Header& header) {
    header = decode_header(bytes);
    if (header.major != version_major) return at_byte(Issue::version_not_supported, 12);
    if (header.file_length > limits.file_bytes) return at_byte(Issue::too_many_bytes, 16);
    if (header.section_count > limits.sections) return at_byte(Issue::too_many_sections, 24);
    if (header.file_length < header_size ||
        header.section_count > (header.file_length - header_size) / section_entry_size)
        return at_byte(Issue::table_outside_file, 24);
    return {};
}

Status check_table(std::span<const std::byte, header_size> header, std::span<const std::byte> table,
                   const Limits& limits, Structure& structure) {
    if (table_checksum(header, table) != structure.header.checksum)
        return at_byte(Issue::table_checksum_mismatch, 56);
    if (!structure.is_newer() && !structure.header.reserved_zero)
        return at_byte(Issue::header_reserved_not_zero, 28);

    structure.sections.resize(structure.header.section_count);
    for (std::size_t i = 0; i < structure.sections.size(); ++i)
        structure.sections[i] =
            decode_section_entry(table.subspan(i * section_entry_size).first<section_entry_size>());

    if (structure.sections.empty() || structure.sections[0].type != type_part)
        return at_byte(Issue::parts_not_first, header_size);
    const Status status = check_places(structure);
    return status.ok() ? check_entries(structure, limits) : status;
}

Status check_entries(const Structure& structure, const Limits& limits) {
    std::uint64_t raw_bytes = 0;
    for (std::size_t i = 0; i < structure.sections.size(); ++i) {
        const SectionEntry& entry = structure.sections[i];
        if (!structure.is_newer() && (entry.flags & ~flag_required) != 0)
            return at_field(Issue::unknown_flags, structure, i, Field::flags);
        if (!structure.knows(entry.type)) {
            if ((entry.flags & flag_required) != 0)
                return at_field(Issue::unknown_required_section, structure, i, Field::type);
            continue;
        }
        const Status status = check_known_entry(structure, i, limits);
        if (!status.ok()) return status;
        if (entry.raw_length > limits.raw_bytes - raw_bytes)
            return at_field(Issue::too_many_raw_bytes, structure, i, Field::raw_length);
        raw_bytes += entry.raw_length;
    }
    return {};
}

} // namespace spa::container
