// SPDX-License-Identifier: Apache-2.0
#include "folds.h"

namespace spa {
namespace {

constexpr unsigned index_bits = 0x3F, end_bit = 0x40, pair_bit = 0x80;

} // namespace

std::array<TriangleEdge, 3> triangle_edges(std::uint32_t cells, std::uint32_t x, std::uint32_t y,
                                           unsigned triangle) {
    const std::array<TexelIndex, 3> corners = triangle_corners(cells, x, y, triangle);
    const auto straight = [&](unsigned a, unsigned b) {
        const unsigned kind = corners[a].y == corners[b].y ? 0 : 1;
        const bool forward = kind == 0 ? corners[a].x < corners[b].x : corners[a].y < corners[b].y;
        const unsigned first = forward ? a : b;
        return TriangleEdge{edge_number(cells, corners[first], kind), {first, a + b - first}};
    };
    return {TriangleEdge{edge_number(cells, {x, y}, 2), {1, 2}}, straight(0, 2), straight(0, 1)};
}

std::vector<std::byte> encode_folds(std::span<const FoldRecord> records) {
    const std::size_t count = records.size();
    std::vector<std::byte> bytes(count * fold_record_bytes);
    std::uint32_t before = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const FoldRecord& r = records[i];
        const std::uint32_t step = r.edge - before;
        before = r.edge;
        const std::array<std::uint32_t, fold_record_bytes> planes{step,
                                                                  step >> 8U,
                                                                  step >> 16U,
                                                                  step >> 24U,
                                                                  r.index | (r.end != 0 ? end_bit : 0) |
                                                                      (r.pair ? pair_bit : 0),
                                                                  r.place,
                                                                  r.cut[0],
                                                                  std::uint32_t(r.cut[0] >> 8U),
                                                                  r.cut[1],
                                                                  std::uint32_t(r.cut[1] >> 8U)};
        for (std::size_t p = 0; p < planes.size(); ++p) bytes[p * count + i] = std::byte(planes[p] & 0xFFU);
    }
    return bytes;
}

std::vector<FoldRecord> decode_folds(std::span<const std::byte> bytes) {
    const std::size_t count = bytes.size() / fold_record_bytes;
    std::vector<FoldRecord> records(count);
    std::uint32_t edge = 0;
    for (std::size_t i = 0; i < count; ++i) {
        records[i] = decode_fold_step(bytes, i);
        records[i].edge = edge += records[i].edge;
    }
    return records;
}

FoldRecord decode_fold_step(std::span<const std::byte> bytes, std::size_t i) {
    const std::size_t count = bytes.size() / fold_record_bytes;
    const auto plane = [&](std::size_t p) { return std::to_integer<std::uint32_t>(bytes[p * count + i]); };
    FoldRecord r;
    r.edge = plane(0) | plane(1) << 8U | plane(2) << 16U | plane(3) << 24U;
    r.index = std::uint8_t(plane(4) & index_bits);
    r.end = (plane(4) & end_bit) != 0 ? 1 : 0;
    r.pair = (plane(4) & pair_bit) != 0;
    r.place = std::uint8_t(plane(5));
    r.cut = {std::uint16_t(plane(6) | plane(7) << 8U), std::uint16_t(plane(8) | plane(9) << 8U)};
    return r;
}

} // namespace spa
