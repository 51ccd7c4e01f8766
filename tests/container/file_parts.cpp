// SPDX-License-Identifier: Apache-2.0
#include "file_parts.h"

#include "../../formats/container/checksum.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace spa::test {

using namespace spa::container;

Section& FileParts::find(std::uint32_t type, std::uint32_t part, std::uint16_t layer, Side side) {
    const auto at = std::find_if(sections.begin(), sections.end(), [&](const Section& s) {
        return s.entry.type == type && s.entry.part == part && s.entry.layer == layer &&
               s.entry.side == std::uint16_t(side);
    });
    if (at != sections.end()) return *at;
    ADD_FAILURE() << "no section " << type_name(type);
    return sections.front();
}

FileBytes write(const SphericalMap& map, Compression compression) {
    FileBytes bytes;
    const Status status = container::write(map, {.compression = compression}, bytes);
    EXPECT_TRUE(status.ok()) << describe(status, "map");
    return bytes;
}

FileParts take_apart(const FileBytes& file) {
    FileParts parts;
    const std::span<const std::byte> bytes(file);
    const Header header = decode_header(bytes.first<header_size>());
    parts.minor = header.minor;
    for (std::size_t i = 0; i < header.section_count; ++i) {
        const SectionEntry entry =
            decode_section_entry(bytes.subspan(entry_field(i, 0)).first<section_entry_size>());
        const auto stored = bytes.subspan(std::size_t(entry.offset), std::size_t(entry.stored_length));
        parts.sections.push_back({entry, FileBytes(stored.begin(), stored.end())});
    }
    return parts;
}

FileBytes put_together(const FileParts& parts) {
    FileBytes file(entry_field(parts.sections.size(), 0));
    for (std::size_t i = 0; i < parts.sections.size(); ++i) {
        SectionEntry entry = parts.sections[i].entry;
        const FileBytes& stored = parts.sections[i].stored;
        file.resize(std::size_t(align(file.size())));
        entry.offset = file.size();
        entry.stored_length = stored.size();
        entry.checksum = checksum(stored);
        file.insert(file.end(), stored.begin(), stored.end());
        encode_section_entry(entry, std::span(file).subspan(entry_field(i, 0)).first<section_entry_size>());
    }
    Header header;
    header.minor = parts.minor;
    header.file_length = file.size();
    header.section_count = std::uint32_t(parts.sections.size());
    encode_header(header, std::span(file).first<header_size>());
    reseal_table(file);
    return file;
}

void reseal_table(FileBytes& file) {
    const std::span<const std::byte> bytes(file);
    const std::uint64_t count = decode_header(bytes.first<header_size>()).section_count;
    const std::size_t room = file.size() - header_size;
    const std::size_t table = std::min(std::size_t(count) * section_entry_size, room);
    store(file.data() + 56, table_checksum(bytes.first<header_size>(), bytes.subspan(header_size, table)));
}

} // namespace spa::test
