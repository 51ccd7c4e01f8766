// SPDX-License-Identifier: Apache-2.0
// The records of a `.spa` file and where their fields lie. The specification is ../SPA.md; this header says
// the same in C++. Records are decoded and encoded field by field, never reinterpreted.
#pragma once

#include "../../libspa/core/spherical_map.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace spa::container {

// "«SPA Map", CR LF ^Z LF: a byte with the high bit, and what text-mode transfers and `type` trip over.
constexpr std::array<std::uint8_t, 12> identifier{0xAB, 0x53, 0x50, 0x41, 0x20, 0x4D,
                                                  0x61, 0x70, 0x0D, 0x0A, 0x1A, 0x0A};
constexpr std::uint16_t version_major = 1;
constexpr std::uint16_t version_minor = 3;

constexpr std::size_t header_size = 64;
constexpr std::size_t section_entry_size = 64;
constexpr std::size_t part_record_size = 192;
constexpr std::size_t bind_size = 96;
constexpr std::uint64_t section_alignment = 64;

// The name's characters in file order, first character in the lowest byte.
constexpr std::uint32_t section_type(const char (&name)[5]) {
    std::uint32_t value = 0;
    for (unsigned i = 0; i < 4; ++i) value |= std::uint32_t(std::uint8_t(name[i])) << (8 * i);
    return value;
}
constexpr std::uint32_t type_part = section_type("PART");
constexpr std::uint32_t type_depth = section_type("DPTH");
constexpr std::uint32_t type_normal = section_type("NRML");
constexpr std::uint32_t type_color = section_type("COLR");
constexpr std::uint32_t type_metadata = section_type("META");
constexpr std::uint32_t type_mixed = section_type("MIXD"); // since minor version 1
constexpr std::uint32_t type_fold = section_type("FOLD");  // since minor version 2
constexpr std::uint32_t type_bind = section_type("BIND");  // since minor version 3
constexpr bool is_image(std::uint32_t type) {
    return type == type_depth || type == type_normal || type == type_color;
}
// A reader may skip it: its required flag is clear.
constexpr bool is_optional(std::uint32_t type) {
    return type == type_metadata || type == type_mixed || type == type_fold || type == type_bind;
}
// Whether the type has a meaning in a file of this minor version. In an older file than its own it is any
// other unknown type, about whose content nothing was promised.
constexpr bool is_known(std::uint32_t type, std::uint16_t minor) {
    return is_image(type) || type == type_part || type == type_metadata ||
           (type == type_mixed && minor >= 1) || (type == type_fold && minor >= 2) ||
           (type == type_bind && minor >= 3);
}
// "PART", ...; bytes that are not printable ASCII come out as '?'.
std::string type_name(std::uint32_t type);

// How a section's bytes are stored.
enum class Scheme : std::uint32_t {
    none = 0,          // as they are
    zstd = 1,          // one Zstandard frame
    filtered_zstd = 2, // images: gradient-predicted byte planes in one Zstandard frame (codec.h)
};
const char* name(Scheme scheme); // "none", "zstd", "filtered-zstd"; "unknown" otherwise

constexpr std::uint32_t flag_required = 1; // a reader that does not know the section must refuse the file

constexpr std::uint32_t part_flag_center_inside = 1; // since minor version 1

enum class Side : std::uint16_t { outer = 0, inner = 1 };

struct Header {
    std::uint16_t major = version_major; // offset 12
    std::uint16_t minor = version_minor; // 14
    std::uint64_t file_length = 0;       // 16
    std::uint32_t section_count = 0;     // 24
    bool reserved_zero = true;           // 28..55
    std::uint64_t checksum = 0;          // 56: of header (these 8 bytes as zero) and table
};

struct SectionEntry {
    std::uint32_t type = 0;                 // offset 0
    std::uint32_t flags = 0;                // 4
    std::uint32_t part = 0;                 // 8
    std::uint16_t layer = 0;                // 12
    std::uint16_t side = 0;                 // 14: a Side
    Scheme scheme = Scheme::none;           // 16; may hold any value until checked
    ElementFormat format = ElementFormat{}; // 20; images only, 0 otherwise; may hold any value until checked
    std::uint32_t width = 0;                // 24
    std::uint32_t height = 0;               // 28
    std::uint64_t offset = 0;               // 32: from the start of the file
    std::uint64_t stored_length = 0;        // 40
    std::uint64_t raw_length = 0;           // 48: decoded
    std::uint64_t checksum = 0;             // 56: of the stored bytes
};

// One part as stored. `part.layers` is left empty.
struct PartRecord {
    Part part;
    std::uint32_t layer_count = 0;
    std::uint32_t flags = 0;   // offset 152; all bits, also those that have no meaning
    bool reserved_zero = true; // 156..191
};

// The identifier is not decoded: compare it first.
Header decode_header(std::span<const std::byte, header_size> bytes);
void encode_header(const Header& header, std::span<std::byte, header_size> bytes);

SectionEntry decode_section_entry(std::span<const std::byte, section_entry_size> bytes);
void encode_section_entry(const SectionEntry& entry, std::span<std::byte, section_entry_size> bytes);

PartRecord decode_part(std::span<const std::byte, part_record_size> bytes);
// Part::to_node: linear part row by row, then the translation.
Affine decode_bind(std::span<const std::byte, bind_size> bytes);
void encode_bind(const Affine& to_node, std::span<std::byte, bind_size> bytes);

// Layer count = part.layers.size(). NaN is stored as the one quiet NaN 0x7FC00000.
void encode_part(const Part& part, std::span<std::byte, part_record_size> bytes);

// The smallest multiple of section_alignment >= offset. offset <= 2^64 - 64.
constexpr std::uint64_t align(std::uint64_t offset) {
    return (offset + (section_alignment - 1)) / section_alignment * section_alignment;
}

} // namespace spa::container
