// SPDX-License-Identifier: Apache-2.0
// Takes `.spa` files apart and puts them together again, right or wrong as a test asks.
#pragma once

#include "../../formats/container/format.h"
#include "../../formats/container/little_endian.h"
#include "../../formats/container/writer.h"

#include <vector>

namespace spa::test {

using FileBytes = std::vector<std::byte>;

struct Section {
    container::SectionEntry entry;
    FileBytes stored;
};

struct FileParts {
    std::uint16_t minor = container::version_minor;
    std::vector<Section> sections;

    // The section of an image, or of a type that is there once. Fails the test if there is none.
    Section& find(std::uint32_t type, std::uint32_t part = 0, std::uint16_t layer = 0,
                  container::Side side = container::Side::outer);
};

// The bytes of a map, written by the writer. Fails the test if that does not work.
FileBytes write(const SphericalMap& map, container::Compression compression = container::Compression::none);

FileParts take_apart(const FileBytes& file);

// Lays the sections out as the format asks. Computes offsets, stored lengths and checksums; keeps all else.
FileBytes put_together(const FileParts& parts);

// Computes the table's checksum anew.
void reseal_table(FileBytes& file);

// Stores a value at an offset of the file and reseals the table.
template <class T>
FileBytes with_value(FileBytes file, std::size_t offset, T value) {
    container::store(file.data() + offset, value);
    reseal_table(file);
    return file;
}

// The offset of a field of entry `section` in the file.
constexpr std::size_t entry_field(std::size_t section, std::size_t field) {
    return container::header_size + section * container::section_entry_size + field;
}

} // namespace spa::test
