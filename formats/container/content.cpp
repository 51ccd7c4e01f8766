// SPDX-License-Identifier: Apache-2.0
#include "content.h"

#include "content_folds.h"
#include "little_endian.h"
#include "text.h"

#include "../../libspa/core/cell_triangles.h"

#include <bit>

namespace spa::container {
namespace {

struct Surroundings {
    const Structure& structure;
    std::uint32_t part;
};

Status at_element(Issue issue, const Surroundings& where, std::uint32_t type, std::uint32_t layer, Side side,
                  std::size_t element, ElementFormat format) {
    const std::size_t section = find_image(where.structure, type, where.part, layer, side);
    return in_section(issue, where.structure, section, element * element_size(format));
}

// Depth codes as integers in the order of the depths: non-negative floats order like their bits.
template <class Code>
std::uint32_t depth_code(const ImageView& image, std::size_t i) {
    return load<Code>(image.bytes.data() + i * sizeof(Code));
}

constexpr std::uint32_t smallest_normal_float = 0x00800000;
constexpr std::uint32_t one_as_float = 0x3F800000;
static_assert(std::bit_cast<std::uint32_t>(1.0F) == one_as_float);

// Integer codes are all valid. A float that the GPU may flush to zero would change from a surface to none.
bool is_depth(std::uint32_t code, ElementFormat format) {
    return format != ElementFormat::f32 || code == 0 ||
           (code >= smallest_normal_float && code <= one_as_float);
}

// From outside in, depths must not grow, and there is nothing below an interval that reaches the centre.
template <class Code>
Status check_depths(const Surroundings& where, const Part& part) {
    const ImageView& first = part.layers[0].outer.depth;
    const std::size_t samples = std::size_t(first.width) * first.height;
    const auto at = [&](Issue issue, std::size_t layer, Side side, std::size_t i) {
        return at_element(issue, where, type_depth, std::uint32_t(layer), side, i, first.format);
    };
    for (std::size_t i = 0; i < samples; ++i) {
        std::uint32_t bound = UINT32_MAX;
        for (std::size_t k = 0; k < part.layers.size(); ++k) {
            const Layer& layer = part.layers[k];
            const std::uint32_t outer = depth_code<Code>(layer.outer.depth, i);
            const std::uint32_t inner = layer.inner.empty() ? 0 : depth_code<Code>(layer.inner.depth, i);
            if (!is_depth(outer, first.format)) return at(Issue::depth_not_valid, k, Side::outer, i);
            if (!is_depth(inner, first.format)) return at(Issue::depth_not_valid, k, Side::inner, i);
            if (inner > outer) return at(Issue::interval_inside_out, k, Side::inner, i);
            if (outer > bound) return at(Issue::layers_out_of_order, k, Side::outer, i);
            bound = inner;
        }
    }
    return {};
}

// Only the border of an octahedral map has samples that are the same point.
template <class Code>
Status check_border(const Surroundings& where, Mapping mapping, const ImageView& image, std::uint32_t layer,
                    Side side) {
    const Grid grid{mapping, image.width, image.height};
    const auto check = [&](std::uint32_t x, std::uint32_t y) {
        const TexelIndex same = canonical(grid, {x, y});
        return depth_code<Code>(image, std::size_t(y) * image.width + x) ==
               depth_code<Code>(image, std::size_t(same.y) * image.width + same.x);
    };
    const auto at = [&](std::uint32_t x, std::uint32_t y) {
        return at_element(Issue::border_differs, where, type_depth, layer, side,
                          std::size_t(y) * image.width + x, image.format);
    };
    for (std::uint32_t i = 0; i < image.width; ++i) {
        for (const std::uint32_t edge : {std::uint32_t(0), image.width - 1}) {
            if (!check(i, edge)) return at(i, edge);
            if (!check(edge, i)) return at(edge, i);
        }
    }
    return {};
}

// Whether two samples have a surface in the same images.
template <class Code>
bool same_surfaces(const Part& part, std::size_t i, std::size_t k) {
    for (const Layer& layer : part.layers) {
        for (const Surface* surface : {&layer.outer, &layer.inner}) {
            if (surface->empty()) continue;
            const ImageView& depth = surface->depth;
            if ((depth_code<Code>(depth, i) == 0) != (depth_code<Code>(depth, k) == 0)) return false;
        }
    }
    return true;
}

// Readers interpolate over triangles that are not mixed without asking again what is at their corners.
template <class Code>
Status check_mixed(const Surroundings& where, const Part& part) {
    const std::size_t width = part.layers[0].outer.depth.width;
    const auto cells = std::uint32_t(width - 1);
    for (std::uint32_t y = 0; y < cells; ++y) {
        for (std::uint32_t x = 0; x < cells; ++x) {
            for (const unsigned triangle : {0U, 1U}) {
                const std::uint64_t bit = triangle_bit(cells, x, y, triangle);
                if (is_mixed(part.mixed, bit)) continue;
                const auto [a, b, c] = triangle_corners(cells, x, y, triangle);
                const std::size_t first = a.y * width + a.x;
                if (same_surfaces<Code>(part, first, b.y * width + b.x) &&
                    same_surfaces<Code>(part, first, c.y * width + c.x))
                    continue;
                const std::size_t section =
                    find_image(where.structure, type_mixed, where.part, 0, Side::outer);
                return in_section(Issue::corners_differ, where.structure, section, bit / 8);
            }
        }
    }
    return {};
}

template <class Code>
Status check_part_depths(const Surroundings& where, const Part& part) {
    Status status = check_depths<Code>(where, part);
    if (!status.ok() || part.mapping != Mapping::octahedral) return status;
    for (std::size_t k = 0; k < part.layers.size(); ++k) {
        const Layer& layer = part.layers[k];
        for (const Side side : {Side::outer, Side::inner}) {
            const Surface& surface = side == Side::outer ? layer.outer : layer.inner;
            if (surface.empty()) continue;
            status = check_border<Code>(where, part.mapping, surface.depth, std::uint32_t(k), side);
            if (!status.ok()) return status;
        }
    }
    if (!part.mixed.empty()) status = check_mixed<Code>(where, part);
    return status.ok() && !part.folds.empty() ? check_folds(where.structure, where.part, part) : status;
}

// The most negative code has no positive counterpart and is not in [-1,1].
template <class Code>
std::size_t find_invalid_code(const ImageView& image) {
    const std::size_t count = image.bytes.size() / sizeof(Code);
    for (std::size_t i = 0; i < count; ++i)
        if (load<Code>(image.bytes.data() + i * sizeof(Code)) == std::numeric_limits<Code>::min())
            return i / 2;
    return count;
}

Status check_normals(const Surroundings& where, const ImageView& image, std::uint32_t layer, Side side) {
    if (image.format != ElementFormat::oct8 && image.format != ElementFormat::oct16) return {};
    const std::size_t elements = std::size_t(image.width) * image.height;
    const std::size_t found = image.format == ElementFormat::oct8 ? find_invalid_code<std::int8_t>(image)
                                                                  : find_invalid_code<std::int16_t>(image);
    if (found >= elements) return {};
    return at_element(Issue::normal_not_valid, where, type_normal, layer, side, found, image.format);
}

Status check_part(const Surroundings& where, const Part& part) {
    const Status status = [&] {
        switch (part.layers[0].outer.depth.format) {
        case ElementFormat::u8: return check_part_depths<std::uint8_t>(where, part);
        case ElementFormat::u16: return check_part_depths<std::uint16_t>(where, part);
        default: return check_part_depths<std::uint32_t>(where, part);
        }
    }();
    if (!status.ok()) return status;
    for (std::size_t k = 0; k < part.layers.size(); ++k) {
        for (const Side side : {Side::outer, Side::inner}) {
            const Surface& surface = side == Side::outer ? part.layers[k].outer : part.layers[k].inner;
            const Status normals = check_normals(where, surface.normal, std::uint32_t(k), side);
            if (!normals.ok()) return normals;
        }
    }
    return {};
}

} // namespace

Status check_content(const Structure& structure, const SphericalMap& map) {
    for (std::size_t i = 0; i < map.parts.size(); ++i) {
        const Status status = check_part({structure, std::uint32_t(i)}, map.parts[i]);
        if (!status.ok()) return status;
    }
    return {};
}

Status check_metadata(const Structure& structure, std::size_t section, std::string_view text) {
    if (const std::size_t at = find_utf8_error(text); at != text_ok)
        return in_section(Issue::metadata_not_utf8, structure, section, at);
    if (const std::size_t at = find_json_error(text); at != text_ok)
        return in_section(Issue::metadata_not_json, structure, section, at);
    return {};
}

} // namespace spa::container
