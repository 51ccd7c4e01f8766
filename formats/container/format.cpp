// SPDX-License-Identifier: Apache-2.0
#include "format.h"

#include "little_endian.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace spa::container {
namespace {

bool all_zero(std::span<const std::byte> bytes) {
    return std::all_of(bytes.begin(), bytes.end(), [](std::byte b) { return b == std::byte{0}; });
}

constexpr std::size_t part_radius = 24;
constexpr std::size_t part_frame = 32;
constexpr std::size_t part_mapping = 104;
constexpr std::size_t part_layers = 108;
constexpr std::size_t part_node = 112;
constexpr std::size_t part_joint = 116;
constexpr std::size_t part_errors = 120;
constexpr std::size_t part_flags = 152;
constexpr std::size_t part_reserved = 156;

Vec3d load_vector(const std::byte* in) {
    return {load<double>(in), load<double>(in + 8), load<double>(in + 16)};
}
void store_vector(std::byte* out, Vec3d v) {
    store(out, v.x);
    store(out + 8, v.y);
    store(out + 16, v.z);
}

} // namespace

std::string type_name(std::uint32_t type) {
    std::string text(4, '?');
    for (unsigned i = 0; i < 4; ++i) {
        const auto c = char((type >> (8 * i)) & 0x7FU);
        if (((type >> (8 * i)) & 0x80U) == 0 && c >= ' ' && c <= '~') text[i] = c;
    }
    return text;
}

const char* name(Scheme scheme) {
    switch (scheme) {
    case Scheme::none: return "none";
    case Scheme::zstd: return "zstd";
    case Scheme::filtered_zstd: return "filtered-zstd";
    }
    return "unknown";
}

Header decode_header(std::span<const std::byte, header_size> bytes) {
    const std::byte* in = bytes.data();
    Header header;
    header.major = load<std::uint16_t>(in + 12);
    header.minor = load<std::uint16_t>(in + 14);
    header.file_length = load<std::uint64_t>(in + 16);
    header.section_count = load<std::uint32_t>(in + 24);
    header.reserved_zero = all_zero(bytes.subspan(28, 28));
    header.checksum = load<std::uint64_t>(in + 56);
    return header;
}

void encode_header(const Header& header, std::span<std::byte, header_size> bytes) {
    std::byte* out = bytes.data();
    std::fill(bytes.begin(), bytes.end(), std::byte{0});
    std::transform(identifier.begin(), identifier.end(), out, [](std::uint8_t b) { return std::byte(b); });
    store(out + 12, header.major);
    store(out + 14, header.minor);
    store(out + 16, header.file_length);
    store(out + 24, header.section_count);
    store(out + 56, header.checksum);
}

SectionEntry decode_section_entry(std::span<const std::byte, section_entry_size> bytes) {
    const std::byte* in = bytes.data();
    SectionEntry entry;
    entry.type = load<std::uint32_t>(in);
    entry.flags = load<std::uint32_t>(in + 4);
    entry.part = load<std::uint32_t>(in + 8);
    entry.layer = load<std::uint16_t>(in + 12);
    entry.side = load<std::uint16_t>(in + 14);
    entry.scheme = Scheme(load<std::uint32_t>(in + 16));
    entry.format = ElementFormat(load<std::uint32_t>(in + 20));
    entry.width = load<std::uint32_t>(in + 24);
    entry.height = load<std::uint32_t>(in + 28);
    entry.offset = load<std::uint64_t>(in + 32);
    entry.stored_length = load<std::uint64_t>(in + 40);
    entry.raw_length = load<std::uint64_t>(in + 48);
    entry.checksum = load<std::uint64_t>(in + 56);
    return entry;
}

void encode_section_entry(const SectionEntry& entry, std::span<std::byte, section_entry_size> bytes) {
    std::byte* out = bytes.data();
    store(out, entry.type);
    store(out + 4, entry.flags);
    store(out + 8, entry.part);
    store(out + 12, entry.layer);
    store(out + 14, entry.side);
    store(out + 16, std::uint32_t(entry.scheme));
    store(out + 20, std::uint32_t(entry.format));
    store(out + 24, entry.width);
    store(out + 28, entry.height);
    store(out + 32, entry.offset);
    store(out + 40, entry.stored_length);
    store(out + 48, entry.raw_length);
    store(out + 56, entry.checksum);
}

PartRecord decode_part(std::span<const std::byte, part_record_size> bytes) {
    const std::byte* in = bytes.data();
    PartRecord record;
    Part& part = record.part;
    part.center = load_vector(in);
    part.radius = load<double>(in + part_radius);
    for (std::size_t i = 0; i < 3; ++i) part.frame.row[i] = load_vector(in + part_frame + 24 * i);
    part.mapping = Mapping(load<std::uint32_t>(in + part_mapping));
    record.layer_count = load<std::uint32_t>(in + part_layers);
    part.node = load<std::int32_t>(in + part_node);
    part.joint = load<std::int32_t>(in + part_joint);
    for (std::size_t i = 0; i < error_figure_fields.size(); ++i)
        part.errors.*error_figure_fields[i].value = load<float>(in + part_errors + 4 * i);
    record.flags = load<std::uint32_t>(in + part_flags);
    part.center_inside = (record.flags & part_flag_center_inside) != 0;
    record.reserved_zero = all_zero(bytes.subspan(part_reserved));
    return record;
}

Affine decode_bind(std::span<const std::byte, bind_size> bytes) {
    Affine map;
    for (std::size_t i = 0; i < 3; ++i) map.linear.row[i] = load_vector(bytes.data() + 24 * i);
    map.translation = load_vector(bytes.data() + 72);
    return map;
}

void encode_bind(const Affine& to_node, std::span<std::byte, bind_size> bytes) {
    for (std::size_t i = 0; i < 3; ++i) store_vector(bytes.data() + 24 * i, to_node.linear.row[i]);
    store_vector(bytes.data() + 72, to_node.translation);
}

void encode_part(const Part& part, std::span<std::byte, part_record_size> bytes) {
    std::byte* out = bytes.data();
    std::fill(bytes.begin(), bytes.end(), std::byte{0});
    store_vector(out, part.center);
    store(out + part_radius, part.radius);
    for (std::size_t i = 0; i < 3; ++i) store_vector(out + part_frame + 24 * i, part.frame.row[i]);
    store(out + part_mapping, std::uint32_t(part.mapping));
    store(out + part_layers, std::uint32_t(part.layers.size()));
    store(out + part_node, part.node);
    store(out + part_joint, part.joint);
    for (std::size_t i = 0; i < error_figure_fields.size(); ++i) {
        const float value = part.errors.*error_figure_fields[i].value;
        std::byte* field = out + part_errors + 4 * i;
        if (std::isnan(value)) {
            store(field, std::uint32_t(0x7FC00000));
        } else {
            store(field, value);
        }
    }
    store(out + part_flags, part.center_inside ? part_flag_center_inside : 0U);
}

} // namespace spa::container
