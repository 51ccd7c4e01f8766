// SPDX-License-Identifier: Apache-2.0
#include "structure.h"

#include "../../libspa/core/cell_triangles.h"
#include "../../libspa/core/folds.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace spa::container {
namespace {

// A frame whose axes are closer to a plane than this (volume over product of lengths) cannot be inverted
// usefully.
constexpr double smallest_frame_volume = 1e-12;
// Lengths in this range have squares that f32 can hold, and frames inverses that f64 can.
constexpr double largest_length = 0x1p60;
constexpr double smallest_length = 0x1p-60;
constexpr std::uint32_t largest_layer_count = 65535; // the layer field of a section has 16 bits

// False for NaN.
bool is_coordinate(double v) { return std::abs(v) <= largest_length; }
bool is_position(Vec3d v) { return is_coordinate(v.x) && is_coordinate(v.y) && is_coordinate(v.z); }
bool is_length(double v) { return v >= smallest_length && v <= largest_length; }

bool is_invertible(const Mat3& m) {
    const Mat3 axes = transpose(m);
    double product = 1;
    for (const Vec3d& axis : axes.row) {
        if (length(axis) < smallest_length) return false;
        product *= length(axis);
    }
    return std::abs(determinant(m)) > smallest_frame_volume * product;
}

bool is_error_figure(float v) { return std::isnan(v) || (std::isfinite(v) && v >= 0); }

bool are_error_figures(const ErrorFigures& e) {
    return is_error_figure(e.texel_distance_max) && is_error_figure(e.texel_distance_mean) &&
           is_error_figure(e.surface_distance_max) && is_error_figure(e.surface_distance_mean) &&
           is_error_figure(e.captured_area) && is_error_figure(e.normal_angle_mean) &&
           is_error_figure(e.color_difference_mean) && is_error_figure(e.quantization_bound);
}

// The issue and the offset in the record of the field at fault.
std::pair<Issue, std::size_t> check_record(const PartRecord& record, const Limits& limits,
                                           std::uint16_t minor) {
    const Part& part = record.part;
    if (!is_position(part.center)) return {Issue::part_number_not_valid, 0};
    if (!is_length(part.radius)) return {Issue::part_number_not_valid, 24};
    if (!is_position(part.frame.row[0]) || !is_position(part.frame.row[1]) || !is_position(part.frame.row[2]))
        return {Issue::part_number_not_valid, 32};
    if (!is_invertible(part.frame)) return {Issue::frame_not_invertible, 32};
    if (part.mapping != Mapping::latlong && part.mapping != Mapping::octahedral)
        return {Issue::unknown_mapping, 104};
    if (record.layer_count == 0 || record.layer_count > largest_layer_count) return {Issue::no_layers, 108};
    if (record.layer_count > limits.layers) return {Issue::too_many_layers, 108};
    if (part.node < -1) return {Issue::index_not_valid, 112};
    if (part.joint < -1) return {Issue::index_not_valid, 116};
    if (!are_error_figures(part.errors)) return {Issue::error_figure_not_valid, 120};
    // The flags came with minor version 1. What a newer version adds to them is ignored.
    if (minor == 0 && record.flags != 0) return {Issue::part_reserved_not_zero, 152};
    if (minor <= version_minor && (record.flags & ~part_flag_center_inside) != 0)
        return {Issue::unknown_part_flags, 152};
    if (minor <= version_minor && !record.reserved_zero) return {Issue::part_reserved_not_zero, 156};
    return {Issue::none, 0};
}

// Sections are unique by this; it also puts the images of a surface side by side.
using Key = std::tuple<std::uint32_t, std::uint32_t, std::uint32_t, std::uint16_t>;
Key key_of(const SectionEntry& entry) { return {entry.part, entry.layer, entry.type, entry.side}; }

struct Index {
    Key key;
    std::uint32_t section = 0;
    friend bool operator<(const Index& a, const Index& b) {
        return std::tie(a.key, a.section) < std::tie(b.key, b.section);
    }
};

const SectionEntry* find_entry(const Structure& structure, const std::vector<Index>& index, Key key) {
    const auto at = std::lower_bound(index.begin(), index.end(), Index{key, 0});
    return at != index.end() && at->key == key ? &structure.sections[at->section] : nullptr;
}

Status check_image_place(const Structure& structure, std::size_t i) {
    const SectionEntry& entry = structure.sections[i];
    if (entry.part >= structure.parts.size() || entry.layer >= structure.parts[entry.part].layer_count ||
        entry.side > std::uint16_t(Side::inner))
        return at_section(Issue::no_such_surface, structure, i);
    const Mapping mapping = structure.parts[entry.part].part.mapping;
    if (!is_valid(Grid{mapping, entry.width, entry.height}))
        return at_section(Issue::image_size_not_valid, structure, i);
    return {};
}

// Of MIXD and FOLD.
Status check_triangles_place(const Structure& structure, std::size_t i, Issue issue) {
    const std::uint32_t part = structure.sections[i].part;
    const bool octahedral =
        part < structure.parts.size() && structure.parts[part].part.mapping == Mapping::octahedral;
    return octahedral ? Status{} : at_section(issue, structure, i);
}

Status check_bind_place(const Structure& structure, std::size_t i) {
    const std::uint32_t part = structure.sections[i].part;
    const bool follows = part < structure.parts.size() && structure.parts[part].part.node >= 0;
    return follows ? Status{} : at_section(Issue::bind_part_not_valid, structure, i);
}

// cells: of the map. fold: may be nullptr.
Status check_fold_length(const Structure& structure, const SectionEntry* fold, bool has_mixed,
                         std::uint32_t cells) {
    if (fold == nullptr) return {};
    const auto section = std::size_t(fold - structure.sections.data());
    if (!has_mixed || cells > most_numbered_cells)
        return at_section(Issue::fold_part_not_valid, structure, section);
    if (fold->raw_length == 0 || fold->raw_length % fold_record_bytes != 0 ||
        fold->raw_length > most_fold_bytes(cells))
        return at_section(Issue::wrong_fold_length, structure, section);
    return {};
}

Status missing(std::uint32_t type, std::uint32_t part, std::uint32_t layer, Side side) {
    Status status = at_byte(Issue::image_missing, header_size);
    status.type = type;
    status.part = part;
    status.layer = std::uint16_t(layer);
    status.side = std::uint16_t(side);
    return status;
}

Status check_part_images(const Structure& structure, const std::vector<Index>& index, std::uint32_t part) {
    const auto find = [&](std::uint32_t type, std::uint32_t layer, Side side) {
        return find_entry(structure, index, Key{part, layer, type, std::uint16_t(side)});
    };
    const SectionEntry* const first = find(type_depth, 0, Side::outer);
    for (std::uint32_t layer = 0; layer < structure.parts[part].layer_count; ++layer) {
        for (const std::uint32_t type : {type_depth, type_normal, type_color})
            if (find(type, layer, Side::outer) == nullptr) return missing(type, part, layer, Side::outer);
        const SectionEntry* const inner = find(type_depth, layer, Side::inner);
        if (inner == nullptr && (find(type_normal, layer, Side::inner) != nullptr ||
                                 find(type_color, layer, Side::inner) != nullptr))
            return missing(type_depth, part, layer, Side::inner);
        for (const SectionEntry* depth : {find(type_depth, layer, Side::outer), inner}) {
            if (depth != nullptr && (depth->format != first->format || depth->width != first->width ||
                                     depth->height != first->height))
                return at_section(Issue::depth_images_differ, structure,
                                  std::size_t(depth - structure.sections.data()));
        }
    }
    const SectionEntry* const mixed = find(type_mixed, 0, Side::outer);
    if (mixed != nullptr && mixed->raw_length != mixed_bytes(first->width - 1))
        return at_section(Issue::wrong_mixed_length, structure,
                          std::size_t(mixed - structure.sections.data()));
    return check_fold_length(structure, find(type_fold, 0, Side::outer), mixed != nullptr, first->width - 1);
}

} // namespace

Status check_parts(std::span<const std::byte> bytes, const Limits& limits, Structure& structure) {
    if (bytes.empty() || bytes.size() % part_record_size != 0)
        return at_section(Issue::wrong_parts_length, structure, 0);
    if (bytes.size() / part_record_size > limits.parts)
        return at_section(Issue::too_many_parts, structure, 0);
    structure.parts.resize(bytes.size() / part_record_size);
    for (std::size_t i = 0; i < structure.parts.size(); ++i) {
        const std::size_t at = i * part_record_size;
        structure.parts[i] = decode_part(bytes.subspan(at).first<part_record_size>());
        const auto [issue, field] = check_record(structure.parts[i], limits, structure.header.minor);
        if (issue != Issue::none) {
            Status status = in_section(issue, structure, 0, at + field);
            status.part = std::uint32_t(i);
            return status;
        }
    }
    return {};
}

Status check_bind(const Structure& structure, std::size_t section, const Affine& to_node) {
    for (std::size_t i = 0; i < 4; ++i)
        if (!is_position(i < 3 ? to_node.linear.row[i] : to_node.translation))
            return in_section(Issue::bind_not_valid, structure, section, 24 * i);
    return is_invertible(to_node.linear) ? Status{}
                                         : in_section(Issue::bind_not_valid, structure, section, 0);
}

Status check_images(const Structure& structure) {
    std::vector<Index> index;
    index.reserve(structure.sections.size());
    for (std::size_t i = 0; i < structure.sections.size(); ++i)
        if (structure.knows(structure.sections[i].type))
            index.push_back({key_of(structure.sections[i]), std::uint32_t(i)});
    std::sort(index.begin(), index.end());
    for (std::size_t i = 1; i < index.size(); ++i)
        if (index[i].key == index[i - 1].key)
            return at_section(Issue::duplicate_section, structure, index[i].section);

    for (std::size_t i = 0; i < structure.sections.size(); ++i) {
        const std::uint32_t type = structure.sections[i].type;
        Status status;
        if (is_image(type)) status = check_image_place(structure, i);
        if (type == type_mixed && structure.knows(type))
            status = check_triangles_place(structure, i, Issue::mixed_part_not_valid);
        if (type == type_fold && structure.knows(type))
            status = check_triangles_place(structure, i, Issue::fold_part_not_valid);
        if (type == type_bind && structure.knows(type)) status = check_bind_place(structure, i);
        if (!status.ok()) return status;
    }
    // A missing image ends the search, so that the work is bounded by the sections and not by the layer
    // counts.
    for (std::size_t part = 0; part < structure.parts.size(); ++part) {
        const Status status = check_part_images(structure, index, std::uint32_t(part));
        if (!status.ok()) return status;
    }
    return {};
}

std::size_t find_image(const Structure& structure, std::uint32_t type, std::uint32_t part,
                       std::uint32_t layer, Side side) {
    const auto at =
        std::find_if(structure.sections.begin(), structure.sections.end(), [&](const SectionEntry& e) {
            return e.type == type && e.part == part && e.layer == layer && e.side == std::uint16_t(side);
        });
    return std::size_t(at - structure.sections.begin());
}

} // namespace spa::container
