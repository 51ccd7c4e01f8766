// SPDX-License-Identifier: Apache-2.0
// libFuzzer target: any bytes through the checker and the readers, which must agree, and every pixel of what
// they accept. Each input is tried as it is and with its checksums made right, since no mutation gets past
// those.
#include "../../formats/container/checksum.h"
#include "../../formats/container/little_endian.h"
#include "../../formats/container/reader.h"
#include "../../formats/container/writer.h"
#include "../../libspa/core/cell_triangles.h"
#include "../../libspa/core/folds.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace {

using namespace spa;
using namespace spa::container;
using FileBytes = std::vector<std::byte>;

constexpr Limits limits{.file_bytes = 1U << 20U,
                        .sections = 256,
                        .parts = 64,
                        .layers = 16,
                        .image_samples = 1U << 16U,
                        .raw_bytes = 1U << 20U,
                        .metadata_bytes = 1U << 16U};

void require(bool condition, const char* what, const Status& status = {}) {
    if (condition) return;
    std::fprintf(stderr, "%s: %s\n", what, describe(status, "input").c_str());
    std::abort();
}

void repair_checksums(FileBytes& file) {
    if (file.size() < header_size) return;
    const std::span<std::byte> bytes(file);
    const std::uint64_t claimed = decode_header(bytes.first<header_size>()).section_count;
    const std::uint64_t count =
        std::min<std::uint64_t>(claimed, (file.size() - header_size) / section_entry_size);
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t at = header_size + i * section_entry_size;
        const SectionEntry entry = decode_section_entry(bytes.subspan(at).first<section_entry_size>());
        if (entry.offset < at + section_entry_size || entry.offset > file.size() ||
            entry.stored_length > file.size() - entry.offset)
            continue;
        store(file.data() + at + 56,
              checksum(bytes.subspan(std::size_t(entry.offset), std::size_t(entry.stored_length))));
    }
    store(file.data() + 56,
          table_checksum(bytes.first<header_size>(),
                         bytes.subspan(header_size, std::size_t(count) * section_entry_size)));
}

double touch(const ImageView& image) {
    double sum = 0;
    for (std::uint32_t y = 0; y < image.height; ++y) {
        for (std::uint32_t x = 0; x < image.width; ++x) {
            const std::byte* const element = image.at(x, y);
            switch (image.format) {
            case ElementFormat::rgba8: sum += std::to_integer<int>(element[3]); break;
            case ElementFormat::u8:
            case ElementFormat::u16:
            case ElementFormat::f32: {
                const float depth = decode_depth(image.format, element);
                require(depth >= 0 && depth <= 1, "depth outside [0, 1]");
                sum += double(depth);
                break;
            }
            default: {
                const Vec3f normal = decode_normal(image.format, element);
                require(is_finite(normal), "normal not finite");
                sum += double(normal.x);
            }
            }
        }
    }
    return sum;
}

double touch_folds(const Part& part) {
    const std::uint32_t cells = part.layers.front().outer.depth.width - 1;
    require(!part.mixed.empty() && part.folds.size() % fold_record_bytes == 0,
            "folds without what they need");
    double sum = 0;
    for (const FoldRecord& record : decode_folds(part.folds)) {
        sum += record.index + record.place + record.cut[0] + record.cut[1];
        require(is_edge(cells, record.edge) && record.cut[0] != 0, "fold record not valid");
        for (const TexelIndex end : edge_ends(cells, record.edge))
            sum += std::to_integer<int>(*part.layers.front().outer.depth.at(end.x, end.y));
    }
    return sum;
}

double touch(const SphericalMap& map) {
    double sum = 0;
    for (const Part& part : map.parts) {
        require(std::isfinite(inverse(part.frame).row[0].x), "frame not invertible");
        require(!part.layers.empty(), "part without layers");
        for (const Layer& layer : part.layers) {
            require(!layer.outer.depth.empty() && !layer.outer.normal.empty() && !layer.outer.color.empty(),
                    "image missing");
            for (const Surface* surface : {&layer.outer, &layer.inner})
                sum += touch(surface->depth) + touch(surface->normal) + touch(surface->color);
        }
        const std::uint32_t cells = part.layers.front().outer.depth.width - 1;
        require(part.mixed.empty() ||
                    (part.mapping == Mapping::octahedral && part.mixed.size() == mixed_bytes(cells)),
                "wrong number of mixed triangles");
        sum += mixed_share(part.mixed);
        if (!part.folds.empty()) sum += touch_folds(part);
    }
    return sum;
}

// Writing what was read, and reading that, changes nothing: neither the file nor what the map looks like.
void round_trip(const SphericalMap& map) {
    FileBytes once;
    const Status status = write(map, {.compression = Compression::none}, once);
    require(status.ok(), "a map that was read cannot be written", status);
    File file;
    require(open(std::span<const std::byte>(once), file).ok(), "a map that was written cannot be read");
    FileBytes twice;
    require(write(file.map(), {.compression = Compression::none}, twice).ok() && once == twice,
            "writing is not stable");
}

void try_file(const FileBytes& bytes) {
    const Status checked = check(bytes, limits);
    const Status structure = check(bytes, limits, CheckDepth::structure);
    require(!checked.ok() || structure.ok(), "full check passes, structure does not", structure);

    File mapped;
    const Status opened = open(std::span<const std::byte>(bytes), mapped, {.limits = limits});
    require(opened.issue == checked.issue && opened.offset == checked.offset, "open and check disagree",
            opened);

    std::size_t used = 0;
    const ReadExactly from_memory = [&](std::span<std::byte> piece) {
        if (piece.size() > bytes.size() - used) return false;
        std::copy_n(bytes.begin() + std::ptrdiff_t(used), piece.size(), piece.begin());
        used += piece.size();
        return true;
    };
    File streamed;
    const Status read_status = read(from_memory, streamed, {.limits = limits});
    // A stream cannot know its length beforehand; in all else the two agree.
    const bool about_length = checked.issue == Issue::file_too_long ||
                              checked.issue == Issue::file_truncated ||
                              checked.issue == Issue::too_many_bytes;
    require(about_length || read_status.issue == checked.issue, "stream and check disagree", read_status);

    File unchecked;
    const ReadOptions trusting{.limits = limits, .depth = CheckDepth::structure};
    const Status trusted = open(std::span<const std::byte>(bytes), unchecked, trusting);
    require(!checked.ok() || trusted.ok(), "full check passes, opening without does not", trusted);

    if (!checked.ok()) {
        require(!describe(checked, "input").empty(), "no message");
        return;
    }
    const double sum = touch(mapped.map());
    require(sum == touch(streamed.map()) && sum == touch(unchecked.map()), "readers see different maps");
    round_trip(mapped.map());
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto* const bytes = reinterpret_cast<const std::byte*>(data);
    FileBytes file(bytes, bytes + size);
    try_file(file);
    repair_checksums(file);
    try_file(file);
    return 0;
}
