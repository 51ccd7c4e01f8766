// SPDX-License-Identifier: Apache-2.0
// What hostile files make the reader allocate, counted in operator new.
#include "file_parts.h"
#include "test_maps.h"

#include "../../formats/container/codec.h"
#include "../../formats/container/reader.h"

#include <cstdlib>
#include <new>

#include <gtest/gtest.h>

namespace {

// Replaced operators cannot be handed anything: the one place for a variable of the program.
struct Heap {
    std::size_t total = 0, largest = 0;
    std::size_t fail_above = SIZE_MAX;
};
Heap heap; // NOLINT(cppcoreguidelines-avoid-non-const-global-variables)

void* allocate(std::size_t size) {
    heap.total += size;
    heap.largest = std::max(heap.largest, size);
    if (size > heap.fail_above) throw std::bad_alloc();
    void* const memory = std::malloc(size == 0 ? 1 : size);
    if (memory == nullptr) throw std::bad_alloc();
    return memory;
}

} // namespace

void* operator new(std::size_t size) { return allocate(size); }
void* operator new[](std::size_t size) { return allocate(size); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }

namespace spa::test {
namespace {

using namespace spa::container;

constexpr std::size_t small = std::size_t(64) << 10U;
// A stream is read in pieces of this size.
constexpr std::size_t stream_small = (std::size_t(1) << 20U) + small;

struct Outcome {
    Issue issue = Issue::none;
    std::size_t total = 0;
};

template <class Run>
Outcome measure(Run run) {
    heap.total = 0;
    const Status status = run();
    return {status.issue, heap.total};
}

// Checks a hostile file as memory and as a stream. `expected`: of the stream too, except that a stream has no
// length to compare.
void expect_little(const FileBytes& bytes, Issue expected, Issue expected_of_stream, const Limits& limits) {
    Outcome outcome = measure([&] { return check(bytes, limits); });
    EXPECT_EQ(number(outcome.issue), number(expected));
    EXPECT_LT(outcome.total, small);

    std::size_t used = 0;
    const ReadExactly from_memory = [&](std::span<std::byte> piece) {
        if (piece.size() > bytes.size() - used) return false;
        std::copy_n(bytes.begin() + std::ptrdiff_t(used), piece.size(), piece.begin());
        used += piece.size();
        return true;
    };
    File file;
    outcome = measure([&] { return read(from_memory, file, {.limits = limits}); });
    EXPECT_EQ(number(outcome.issue), number(expected_of_stream));
    EXPECT_LT(outcome.total, stream_small);
}

FileBytes good_file() {
    TestPart part;
    part.mixed = false;
    return write(make_map({part}).map);
}

constexpr std::uint64_t huge = std::uint64_t(1) << 60U;

// Without any limits, so that only the rules of the format stand between a claim and an allocation.
TEST(Allocation, HugeClaimsOfTheHeader) {
    FileBytes bytes = good_file();
    store(bytes.data() + 16, huge);
    store(bytes.data() + 24, std::uint32_t(0xFFFFFFFF));
    reseal_table(bytes);
    expect_little(bytes, Issue::file_truncated, Issue::file_truncated, no_limits);
    expect_little(bytes, Issue::too_many_bytes, Issue::too_many_bytes, {});
}

TEST(Allocation, HugeClaimsOfSections) {
    const FileBytes good = good_file();
    const std::size_t last = take_apart(good).sections.size() - 1;
    const std::uint64_t offset = take_apart(good).sections[last].entry.offset;
    FileBytes bytes = good;
    store(bytes.data() + entry_field(last, 40), huge);
    store(bytes.data() + entry_field(last, 48), huge);
    store(bytes.data() + entry_field(last, 24), std::uint32_t(1) << 29U);
    store(bytes.data() + entry_field(last, 28), std::uint32_t(1) << 29U);
    store(bytes.data() + 16, offset + huge);
    reseal_table(bytes);
    // An image of 2^58 elements with the right lengths, in a file that says it is long enough.
    expect_little(bytes, Issue::file_truncated, Issue::image_size_not_valid, no_limits);
}

TEST(Allocation, HugeClaimsOfMixedTriangles) {
    FileParts parts = take_apart(write(make_map({TestPart{}}).map));
    Section& section = parts.find(type_mixed);
    section.stored = compress(FileBytes(std::size_t(16) << 20U), 1);
    section.entry.scheme = Scheme::zstd;
    section.entry.raw_length = std::uint64_t(16) << 20U;
    // What the frame holds, but not what the map has.
    expect_little(put_together(parts), Issue::wrong_mixed_length, Issue::wrong_mixed_length, no_limits);
    expect_little(put_together(parts), Issue::too_many_raw_bytes, Issue::too_many_raw_bytes,
                  {.raw_bytes = std::uint64_t(1) << 20U});
    section.entry.raw_length = huge;
    expect_little(put_together(parts), Issue::impossible_ratio, Issue::impossible_ratio, no_limits);
}

// What a frame of 16 MiB of zeros claims to be. The map has 5 x 5 samples.
TEST(Allocation, HugeClaimsOfFolds) {
    FileParts parts = take_apart(write(make_map({TestPart{}}).map));
    Section& section = parts.find(type_fold);
    section.stored = compress(FileBytes(std::size_t(16) << 20U), 1);
    section.entry.scheme = Scheme::zstd;
    section.entry.raw_length = 16'000'000;
    expect_little(put_together(parts), Issue::wrong_fold_length, Issue::wrong_fold_length, no_limits);
    // As many as there may be of this map, but not what the frame says.
    section.entry.raw_length = 3U * 5 * 5 * 64 * 10;
    expect_little(put_together(parts), Issue::wrong_frame_size, Issue::wrong_frame_size, no_limits);
    section.entry.raw_length = huge;
    expect_little(put_together(parts), Issue::impossible_ratio, Issue::impossible_ratio, no_limits);
}

TEST(Allocation, ALongUnknownSectionIsNotHeld) {
    const FileBytes good = good_file();
    FileParts parts = take_apart(good);
    Section section;
    section.entry.type = section_type("LONG");
    section.stored.resize(std::size_t(16) << 20U);
    parts.sections.push_back(section);
    const FileBytes bytes = put_together(parts);
    std::size_t used = 0;
    const ReadExactly from_memory = [&](std::span<std::byte> piece) {
        std::copy_n(bytes.begin() + std::ptrdiff_t(used), piece.size(), piece.begin());
        used += piece.size();
        return true;
    };
    File file;
    heap.largest = 0;
    EXPECT_TRUE(read(from_memory, file).ok());
    EXPECT_LT(heap.largest, stream_small);
}

TEST(Allocation, ManyLayersWithoutImages) {
    FileBytes bytes = good_file();
    FileParts parts = take_apart(bytes);
    store(parts.sections[0].stored.data() + 108, std::uint32_t(65535));
    expect_little(put_together(parts), Issue::image_missing, Issue::image_missing, no_limits);
}

// 4 GiB of zeros in 130 kB, whatever the scheme.
TEST(Allocation, CompressionBombs) {
    TestPart spec;
    spec.layers = 1;
    FileParts parts = take_apart(write(make_map({spec}).map));
    Section& section = parts.find(type_color);
    section.stored = compress(FileBytes(std::size_t(16) << 20U), 1);
    section.entry.scheme = Scheme::zstd;
    section.entry.width = section.entry.height = 2049;
    section.entry.raw_length = 4U * 2049 * 2049;
    // Within the ratio, but not what the frame says.
    expect_little(put_together(parts), Issue::wrong_frame_size, Issue::wrong_frame_size, {});
    expect_little(put_together(parts), Issue::too_many_raw_bytes, Issue::too_many_raw_bytes,
                  {.raw_bytes = std::uint64_t(1) << 20U});
    expect_little(put_together(parts), Issue::too_many_samples, Issue::too_many_samples,
                  {.image_samples = std::uint64_t(1) << 20U});
    // A frame that lies about its size is refused by the ratio before the frame is looked at.
    section.entry.width = section.entry.height = 65537;
    section.entry.raw_length = std::uint64_t(4) * 65537 * 65537;
    expect_little(put_together(parts), Issue::impossible_ratio, Issue::impossible_ratio, no_limits);
}

TEST(Allocation, OutOfMemoryIsAStatus) {
    const TestMap map = make_map({TestPart{}});
    FileBytes bytes = write(map.map, Compression::zstd);
    for (std::size_t limit = 0; limit < 4096; limit += 16) {
        File file;
        heap.fail_above = limit;
        const Status opened = open(std::span<const std::byte>(bytes), file);
        const Status checked = check(bytes);
        std::vector<std::byte> out;
        const Status written = container::write(map.map, {}, out);
        heap.fail_above = SIZE_MAX;
        for (const Status& status : {opened, checked, written})
            EXPECT_TRUE(status.ok() || status.issue == Issue::out_of_memory) << number(status.issue);
        if (limit == 0) {
            EXPECT_EQ(opened.issue, Issue::out_of_memory);
            EXPECT_EQ(written.issue, Issue::out_of_memory);
            EXPECT_EQ(exit_code(opened.issue), ExitCode::internal);
        }
    }
}

} // namespace
} // namespace spa::test
