// SPDX-License-Identifier: Apache-2.0
#include "writer.h"

#include "checksum.h"
#include "codec.h"
#include "content.h"
#include "file_io.h"

#include <algorithm>
#include <new>

namespace spa::container {
namespace {

std::span<const std::byte> bytes_of(const std::string& text) {
    return std::as_bytes(std::span(text.data(), text.size()));
}

// The file as it will be, before compression: entries and, beside each, its raw bytes.
struct Plan {
    Structure structure;
    std::vector<std::byte> parts, binds;
    std::vector<std::span<const std::byte>> raw;
};

bool is_view_valid(const ImageView& view) {
    const std::size_t size = element_size(view.format);
    return size != 0 && view.width != 0 && view.height != 0 && view.bytes.size() % size == 0 &&
           view.bytes.size() / size == std::uint64_t(view.width) * view.height;
}

class Planner {
public:
    explicit Planner(Plan& plan) : plan_(plan) {}

    Status add_map(const SphericalMap& map) {
        plan_.parts.resize(map.parts.size() * part_record_size);
        for (std::size_t i = 0; i < map.parts.size(); ++i) {
            encode_part(map.parts[i],
                        std::span(plan_.parts).subspan(i * part_record_size).first<part_record_size>());
        }
        plan_.binds.resize(map.parts.size() * bind_size);
        add({.type = type_part, .flags = flag_required}, plan_.parts);
        if (!map.metadata.empty()) add({.type = type_metadata}, bytes_of(map.metadata));
        for (std::size_t i = 0; i < map.parts.size(); ++i) {
            const std::vector<Layer>& layers = map.parts[i].layers;
            if (layers.size() > UINT16_MAX) return {}; // check_parts refuses it
            for (std::size_t k = 0; k < layers.size(); ++k) {
                for (const Side side : {Side::outer, Side::inner}) {
                    const Status status = add_surface(
                        side == Side::outer ? layers[k].outer : layers[k].inner,
                        {.part = std::uint32_t(i), .layer = std::uint16_t(k), .side = std::uint16_t(side)});
                    if (!status.ok()) return status;
                }
            }
            const Part& part = map.parts[i];
            if (!part.mixed.empty()) add({.type = type_mixed, .part = std::uint32_t(i)}, part.mixed);
            if (!part.folds.empty()) add({.type = type_fold, .part = std::uint32_t(i)}, part.folds);
            if (part.to_node == Affine{}) continue;
            const auto bind = std::span(plan_.binds).subspan(i * bind_size).first<bind_size>();
            encode_bind(part.to_node, bind);
            add({.type = type_bind, .part = std::uint32_t(i)}, bind);
        }
        return {};
    }

private:
    void add(SectionEntry entry, std::span<const std::byte> raw) {
        entry.raw_length = raw.size();
        entry.stored_length = raw.size();
        plan_.structure.sections.push_back(entry);
        plan_.raw.push_back(raw);
    }

    Status add_surface(const Surface& surface, SectionEntry place) {
        return add_image(surface.depth, type_depth, place) && add_image(surface.normal, type_normal, place) &&
                       add_image(surface.color, type_color, place)
                   ? Status{}
                   : at_section(Issue::image_view_not_valid, plan_.structure,
                                plan_.structure.sections.size() - 1);
    }

    bool add_image(const ImageView& view, std::uint32_t type, SectionEntry entry) {
        if (view.empty()) return true;
        entry.type = type;
        entry.flags = flag_required;
        entry.format = view.format;
        entry.width = view.width;
        entry.height = view.height;
        add(entry, view.bytes);
        return is_view_valid(view);
    }

    Plan& plan_;
};

// Depths and normals are smooth: the filter always gains there. Colours may be flat or noisy: both are tried.
void compress_section(SectionEntry& entry, int level, std::span<const std::byte> raw,
                      std::vector<std::byte>& out) {
    entry.scheme = is_image(entry.type) ? Scheme::filtered_zstd : Scheme::zstd;
    out = entry.scheme == Scheme::filtered_zstd
              ? compress(filter(entry.format, entry.width, entry.height, raw), level)
              : compress(raw, level);
    if (entry.type == type_color) {
        std::vector<std::byte> plain = compress(raw, level);
        if (plain.size() < out.size()) {
            out = std::move(plain);
            entry.scheme = Scheme::zstd;
        }
    }
    if (out.size() >= raw.size()) {
        entry.scheme = Scheme::none;
        out.clear();
    }
    entry.stored_length = out.empty() ? raw.size() : out.size();
}

// The pieces of the file in order. They point into the plan, the map and this object.
struct Image {
    std::vector<std::byte> front; // header and table
    std::vector<std::vector<std::byte>> compressed;
    std::vector<std::span<const std::byte>> pieces;
};

constexpr std::array<std::byte, section_alignment> padding{};

void build(Plan& plan, const WriteOptions& options, Image& image) {
    std::vector<SectionEntry>& sections = plan.structure.sections;
    image.front.resize(header_size + sections.size() * section_entry_size);
    image.compressed.resize(sections.size());
    image.pieces.push_back(image.front);
    std::uint64_t end = image.front.size();
    for (std::size_t i = 0; i < sections.size(); ++i) {
        SectionEntry& entry = sections[i];
        if (options.compression == Compression::zstd && entry.type != type_part)
            compress_section(entry, options.zstd_level, plan.raw[i], image.compressed[i]);
        const std::span<const std::byte> stored =
            entry.scheme == Scheme::none ? plan.raw[i] : std::span<const std::byte>(image.compressed[i]);
        entry.offset = align(end);
        entry.checksum = checksum(stored);
        image.pieces.push_back(std::span(padding).first(std::size_t(entry.offset - end)));
        image.pieces.push_back(stored);
        end = entry.offset + entry.stored_length;
        encode_section_entry(
            entry,
            std::span(image.front).subspan(header_size + i * section_entry_size).first<section_entry_size>());
    }
    Header header;
    header.file_length = end;
    header.section_count = std::uint32_t(sections.size());
    const auto front = std::span(image.front).first<header_size>();
    encode_header(header, front);
    header.checksum = table_checksum(front, std::span(image.front).subspan(header_size));
    encode_header(header, front);
}

// The rules of a reader, asked before the map's views are trusted.
Status check_plan(const SphericalMap& map, Plan& plan) {
    Status status = check_parts(plan.parts, no_limits, plan.structure);
    if (status.ok()) status = check_entries(plan.structure, no_limits);
    if (status.ok()) status = check_images(plan.structure);
    for (std::size_t i = 0; status.ok() && i < plan.structure.sections.size(); ++i)
        if (const SectionEntry& entry = plan.structure.sections[i]; entry.type == type_bind)
            status = check_bind(plan.structure, i, map.parts[entry.part].to_node);
    if (status.ok()) status = check_content(plan.structure, map);
    if (status.ok() && !map.metadata.empty()) status = check_metadata(plan.structure, 1, map.metadata);
    return status;
}

// Calls `deliver` with the finished image.
template <class Deliver>
Status write_with(const SphericalMap& map, const WriteOptions& options, Deliver deliver) noexcept {
    try {
        Plan plan;
        Status status = Planner(plan).add_map(map);
        if (status.ok()) status = check_plan(map, plan);
        if (!status.ok()) return status;
        Image image;
        build(plan, options, image);
        return deliver(image);
    } catch (const std::bad_alloc&) {
        return at_byte(Issue::out_of_memory, 0);
    }
}

} // namespace

Status write(const SphericalMap& map, const WriteOptions& options, std::vector<std::byte>& out) noexcept {
    return write_with(map, options, [&out](const Image& image) {
        out.clear();
        for (const std::span<const std::byte> piece : image.pieces)
            out.insert(out.end(), piece.begin(), piece.end());
        return Status{};
    });
}

Status write(const SphericalMap& map, const WriteOptions& options, const std::string& path) noexcept {
    return write_with(map, options, [&path](const Image& image) { return write_file(path, image.pieces); });
}

} // namespace spa::container
