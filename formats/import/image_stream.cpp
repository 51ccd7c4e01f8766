// SPDX-License-Identifier: Apache-2.0
#include "image_stream.h"

#include <algorithm>
#include <cstdint>
#include <string_view>

namespace spa::import {
namespace {

unsigned value(std::span<const std::byte> bytes, std::size_t at) {
    return std::to_integer<unsigned>(bytes[at]);
}

std::size_t big_endian(std::span<const std::byte> bytes, std::size_t at, std::size_t count) {
    std::size_t result = 0;
    for (std::size_t i = 0; i < count; ++i) result = result << 8U | value(bytes, at + i);
    return result;
}

void append(std::vector<std::byte>& to, std::span<const std::byte> bytes) {
    to.insert(to.end(), bytes.begin(), bytes.end());
}

bool is_essential_chunk(std::span<const std::byte> type) {
    constexpr unsigned ancillary = 0x20; // of the first letter: PNG, 5.4
    if ((value(type, 0) & ancillary) == 0) return true;
    constexpr std::string_view transparency = "tRNS";
    return std::equal(transparency.begin(), transparency.end(), type.begin(), type.end(),
                      [](char a, std::byte b) { return static_cast<std::byte>(a) == b; });
}

// A marker segment, or a marker that stands alone, with the bytes before it that belong to none.
struct Segment {
    unsigned marker = 0; // 0: the end of the file
    std::size_t begin = 0, end = 0;
};

constexpr unsigned end_of_image = 0xD9, start_of_scan = 0xDA, comment = 0xFE;

bool has_length(unsigned marker) { return marker != 0x01 && !(marker >= 0xD0 && marker <= end_of_image); }

// As decoders do it: what is no marker is skipped, entropy-coded data too, in which FF 00 stands for the byte
// FF (ITU T.81, B.1.1.5).
Segment next_segment(std::span<const std::byte> bytes, std::size_t at) {
    while (at + 1 < bytes.size()) {
        const unsigned marker = value(bytes, at + 1);
        if (value(bytes, at) != 0xFF || marker == 0x00 || marker == 0xFF) {
            ++at;
            continue;
        }
        if (!has_length(marker)) return {marker, at, at + 2};
        if (bytes.size() - at < 4) break;
        const std::size_t length = std::max<std::size_t>(big_endian(bytes, at + 2, 2), 2);
        return {marker, at, at + 2 + std::min(length, bytes.size() - at - 2)};
    }
    return {0, bytes.size(), bytes.size()};
}

bool is_essential_segment(unsigned marker) {
    constexpr unsigned app0 = 0xE0, app14 = 0xEE, app15 = 0xEF;
    if (marker == comment) return false;
    return marker < app0 || marker > app15 || marker == app0 || marker == app14;
}

} // namespace

std::optional<std::vector<std::byte>> essential_png(std::span<const std::byte> bytes) {
    constexpr std::size_t signature = 8, overhead = 12; // of a chunk: length, type and checksum
    std::vector<std::byte> out;
    append(out, bytes.first(std::min(signature, bytes.size())));
    for (std::size_t at = signature; at < bytes.size() && bytes.size() - at >= overhead;) {
        const std::size_t length = big_endian(bytes, at, 4);
        const std::size_t end = at + overhead + std::min(length, bytes.size() - at - overhead);
        const std::span<const std::byte> type = bytes.subspan(at + 4, 4);
        if (is_essential_chunk(type)) append(out, bytes.subspan(at, end - at));
        at = end;
    }
    if (out.size() == bytes.size()) return std::nullopt;
    return out;
}

std::optional<std::vector<std::byte>> essential_jpeg(std::span<const std::byte> bytes) {
    std::vector<std::byte> out;
    std::size_t at = 0;
    while (at < bytes.size()) {
        const Segment segment = next_segment(bytes, at);
        if (segment.marker == 0 || segment.marker == start_of_scan) break;
        if (is_essential_segment(segment.marker))
            append(out, bytes.subspan(segment.begin, segment.end - segment.begin));
        at = segment.end;
    }
    append(out, bytes.subspan(at));
    if (out.size() == bytes.size()) return std::nullopt;
    return out;
}

std::size_t jpeg_scans(std::span<const std::byte> bytes) {
    std::size_t scans = 0;
    for (std::size_t at = 0; at < bytes.size();) {
        const Segment segment = next_segment(bytes, at);
        if (segment.marker == 0 || segment.marker == end_of_image) break;
        if (segment.marker == start_of_scan) ++scans;
        at = segment.end;
    }
    return scans;
}

} // namespace spa::import
