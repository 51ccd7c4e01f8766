// SPDX-License-Identifier: Apache-2.0
// Everything a `.spa` file says before its pixels: header, section table, parts; and all the rules that can
// be checked on it alone. The steps are those of ../SPA.md, "Reading", in that order; each relies on the ones
// before.
#pragma once

#include "format.h"
#include "limits.h"
#include "status.h"

#include <vector>

namespace spa::container {

struct Structure {
    Header header;
    std::vector<SectionEntry> sections;
    std::vector<PartRecord> parts;

    // A newer minor version may use what is reserved today; a reader of today ignores it.
    [[nodiscard]] bool is_newer() const { return header.minor > version_minor; }
    [[nodiscard]] bool knows(std::uint32_t type) const { return is_known(type, header.minor); }
};

// A status that points at byte `offset` of the file.
Status at_byte(Issue issue, std::uint64_t offset);
// ... at section `index`: at its first byte, or at byte `offset` of the decoded section.
Status at_section(Issue issue, const Structure& structure, std::size_t index);
Status in_section(Issue issue, const Structure& structure, std::size_t index, std::uint64_t offset);

// `bytes` is what there is of the first identifier.size() bytes.
Status check_identifier(std::span<const std::byte> bytes);

// Version, length and count.
Status check_header(std::span<const std::byte, header_size> bytes, const Limits& limits, Header& header);

// The checksum, and every rule about single entries and where sections lie. Fills structure.sections;
// structure.header is the result of check_header. O(sections).
Status check_table(std::span<const std::byte, header_size> header, std::span<const std::byte> table,
                   const Limits& limits, Structure& structure);

// The part of check_table about what entries say, without where they lie. O(sections).
Status check_entries(const Structure& structure, const Limits& limits);

// The records of the PART section, whose checksum is right. Fills structure.parts. O(parts).
Status check_parts(std::span<const std::byte> bytes, const Limits& limits, Structure& structure);

// What a BIND section holds: finite, not too large, invertible.
Status check_bind(const Structure& structure, std::size_t section, const Affine& to_node);

// Every image belongs to a part, has a possible size, is there once; none is missing. The bits of mixed
// triangles belong to an octahedral part and are as many as it has, folds to one with such bits, and are no
// more than there can be; what binds a part belongs to one that follows a node. O(sections log sections).
Status check_images(const Structure& structure);

// The section of an image, or of a part's mixed triangles or folds (layer 0, outer);
// structure.sections.size() if there is none. O(sections).
std::size_t find_image(const Structure& structure, std::uint32_t type, std::uint32_t part,
                       std::uint32_t layer, Side side);

} // namespace spa::container
