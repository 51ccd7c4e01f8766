// SPDX-License-Identifier: Apache-2.0
// Every way to cut a small file short and every bit of it flipped.
#include "file_parts.h"
#include "test_maps.h"

#include "../../formats/container/reader.h"

#include <gtest/gtest.h>

namespace spa::test {
namespace {

using namespace spa::container;

std::vector<FileBytes> small_files() {
    TestPart part;
    part.width = part.height = part.color_width = part.color_height = 3;
    const TestMap map = make_map({part});
    EXPECT_FALSE(map.map.parts[0].folds.empty());
    return {write(map.map), write(map.map, Compression::zstd)};
}

Status read_stream(const FileBytes& file, std::size_t& used, File& out) {
    used = 0;
    const ReadExactly from_memory = [&](std::span<std::byte> piece) {
        if (piece.size() > file.size() - used) return false;
        std::copy_n(file.begin() + std::ptrdiff_t(used), piece.size(), piece.begin());
        used += piece.size();
        return true;
    };
    return read(from_memory, out);
}

TEST(Damage, EveryTruncationIsRefused) {
    for (const FileBytes& file : small_files()) {
        for (std::size_t length = 0; length < file.size(); ++length) {
            const FileBytes cut(file.begin(), file.begin() + std::ptrdiff_t(length));
            const Issue expected = length < header_size ? Issue::file_too_short : Issue::file_truncated;
            EXPECT_EQ(check(cut).issue, expected) << length;
            EXPECT_EQ(check(cut, {}, CheckDepth::structure).issue, expected) << length;
            File streamed;
            std::size_t used = 0;
            EXPECT_EQ(read_stream(cut, used, streamed).issue, expected) << length;
            EXPECT_TRUE(streamed.map().parts.empty());
        }
    }
}

TEST(Damage, EveryFlippedBitIsRefused) {
    for (FileBytes file : small_files()) {
        for (std::size_t i = 0; i < file.size(); ++i) {
            for (unsigned bit = 0; bit < 8; ++bit) {
                file[i] ^= std::byte(1U << bit);
                EXPECT_FALSE(check(file).ok()) << "byte " << i << " bit " << bit;
                file[i] ^= std::byte(1U << bit);
            }
        }
        EXPECT_TRUE(check(file).ok());
    }
}

TEST(Damage, StructureAloneCoversHeaderTableAndParts) {
    for (FileBytes file : small_files()) {
        const SectionEntry parts = take_apart(file).sections[0].entry;
        const std::size_t end = std::size_t(parts.offset + parts.stored_length);
        for (std::size_t i = 0; i < end; ++i) {
            for (unsigned value = 1; value < 256; ++value) {
                file[i] ^= std::byte(value);
                EXPECT_FALSE(check(file, {}, CheckDepth::structure).ok()) << "byte " << i << " xor " << value;
                file[i] ^= std::byte(value);
            }
        }
    }
}

// With the checksums made right again, a wrong header or table must not pass as another valid file of the
// same content: it is refused, or what changed is something the file may freely say.
TEST(Damage, EveryTableByteChangedUnderARightChecksum) {
    const FileBytes file = small_files()[0];
    const std::size_t last = take_apart(file).sections.size() - 1;
    const std::size_t table_end = entry_field(take_apart(file).sections.size(), 0);
    for (std::size_t i = 0; i < table_end; ++i) {
        if (i >= 56 && i < 64) continue; // the checksum itself
        for (unsigned value = 1; value < 256; ++value) {
            FileBytes changed = file;
            changed[i] ^= std::byte(value);
            reseal_table(changed);
            if (!check(changed).ok()) continue;
            const bool is_minor_version = i == 14 || i == 15;
            // An optional section of unknown type: META or FOLD under another name; MIXD is needed by FOLD.
            const bool is_optional_type = (i >= entry_field(1, 0) && i < entry_field(1, 4)) ||
                                          (i >= entry_field(last, 0) && i < entry_field(last, 4));
            EXPECT_TRUE(is_minor_version || is_optional_type) << "byte " << i << " xor " << value;
        }
    }
}

TEST(Damage, ExtraBytesAreRefusedAndAStreamStopsBeforeThem) {
    for (FileBytes file : small_files()) {
        const std::size_t length = file.size();
        file.resize(length + 100);
        EXPECT_EQ(check(file).issue, Issue::file_too_long);
        File streamed;
        std::size_t used = 0;
        EXPECT_TRUE(read_stream(file, used, streamed).ok());
        EXPECT_EQ(used, length);
    }
}

} // namespace
} // namespace spa::test
