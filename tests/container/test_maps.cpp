// SPDX-License-Identifier: Apache-2.0
#include "test_maps.h"

#include "../../libspa/core/cell_triangles.h"
#include "../../libspa/core/folds.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace spa::test {
namespace {

// Smooth, different in every direction, in [0, 1].
double bump(Vec3d u, double phase) {
    return 0.5 + 0.25 * std::sin(5 * u.x + phase) + 0.25 * std::cos(4 * u.y - 3 * u.z + phase);
}

template <class Encode>
ImageView add_image(TestMap& out, const Grid& grid, ElementFormat format, Encode encode) {
    const std::size_t size = element_size(format);
    out.pixels.push_back(
        std::make_unique<std::vector<std::byte>>(std::size_t(grid.width) * grid.height * size));
    std::byte* at = out.pixels.back()->data();
    for (std::uint32_t y = 0; y < grid.height; ++y) {
        for (std::uint32_t x = 0; x < grid.width; ++x) {
            encode(normalize(sample_direction(grid, {x, y})), at);
            at += size;
        }
    }
    return {*out.pixels.back(), grid.width, grid.height, format};
}

// The depth of crossing i of n in direction u, 0 in the holes.
double shell_depth(Vec3d u, unsigned i, unsigned n) {
    if (bump(u, 9) > 0.85) return 0;
    return 1 - (i + 0.8 * bump(u, 1)) / n;
}

void store_color(Vec3d u, unsigned i, std::byte* out) {
    out[0] = std::byte(std::lround(255 * bump(u, 2)));
    out[1] = std::byte(std::lround(255 * bump(u, 3)));
    out[2] = std::byte(40 * i);
    out[3] = std::byte(std::lround(255 * bump(u, 4)));
}

Surface make_surface(TestMap& out, const TestPart& spec, unsigned i, unsigned n, bool with_color) {
    const Grid grid{spec.mapping, spec.width, spec.height};
    const Grid color_grid{spec.mapping, spec.color_width, spec.color_height};
    Surface surface;
    surface.depth = add_image(out, grid, spec.depth, [&](Vec3d u, std::byte* at) {
        const double d = shell_depth(u, i, n);
        if (d > 0) encode_depth(spec.depth, d, at);
    });
    surface.normal = add_image(out, grid, spec.normal, [&](Vec3d u, std::byte* at) {
        if (shell_depth(u, i, n) > 0) encode_normal(spec.normal, normalize(u + Vec3d{0.1 * i, 0.2, 0}), at);
    });
    if (with_color)
        surface.color = add_image(out, color_grid, ElementFormat::rgba8,
                                  [&](Vec3d u, std::byte* at) { store_color(u, i, at); });
    return surface;
}

// Triangles over the edge of a hole are mixed, and some others.
std::span<const std::byte> add_mixed(TestMap& out, const TestPart& spec) {
    const Grid grid{spec.mapping, spec.width, spec.height};
    const std::uint32_t cells = spec.width - 1;
    out.pixels.push_back(std::make_unique<std::vector<std::byte>>(std::size_t(mixed_bytes(cells))));
    std::vector<std::byte>& bytes = *out.pixels.back();
    const auto is_hole = [&](TexelIndex t) {
        return shell_depth(normalize(sample_direction(grid, t)), 0, 1) == 0;
    };
    for (std::uint32_t y = 0; y < cells; ++y) {
        for (std::uint32_t x = 0; x < cells; ++x) {
            for (const unsigned triangle : {0U, 1U}) {
                const auto [a, b, c] = triangle_corners(cells, x, y, triangle);
                const bool pure = is_hole(a) == is_hole(b) && is_hole(a) == is_hole(c);
                const std::uint64_t bit = triangle_bit(cells, x, y, triangle);
                if (pure && bit % 5 != 0) continue;
                bytes[std::size_t(bit / 8)] |= std::byte(1U << unsigned(bit % 8));
            }
        }
    }
    return bytes;
}

// By edges, whether all of their triangles are mixed.
std::vector<bool> edges_between_mixed(std::span<const std::byte> mixed, std::uint32_t cells) {
    std::vector<bool> any(edge_count(cells)), pure(edge_count(cells));
    for (std::uint32_t y = 0; y < cells; ++y)
        for (std::uint32_t x = 0; x < cells; ++x)
            for (const unsigned triangle : {0U, 1U})
                for (const TriangleEdge& e : triangle_edges(cells, x, y, triangle))
                    (is_mixed(mixed, triangle_bit(cells, x, y, triangle)) ? any : pure)[e.edge] = true;
    for (std::size_t i = 0; i < any.size(); ++i) any[i] = any[i] && !pure[i];
    return any;
}

// Of end 0 a pair and the innermost that is left, of end 1 the innermost.
std::span<const std::byte> add_folds(TestMap& out, const TestPart& spec, std::span<const std::byte> mixed) {
    const Grid grid{spec.mapping, spec.width, spec.height};
    const std::uint32_t cells = spec.width - 1;
    const auto crossings = [&](TexelIndex t) {
        const bool is_hole = shell_depth(normalize(sample_direction(grid, t)), 0, 1) == 0;
        return is_hole ? 0 : 2 * spec.layers - (spec.solid_core ? 1 : 0);
    };
    std::vector<FoldRecord> records;
    const auto add = [&](std::uint32_t edge, unsigned end, bool pair, unsigned index) {
        const auto place = std::uint8_t(37 * records.size() % 256);
        const auto code = std::uint16_t(1 + 9779 * records.size() % 65535);
        records.push_back({edge,
                           pair,
                           std::uint8_t(end),
                           std::uint8_t(index),
                           place,
                           {code, pair ? std::uint16_t(65536 - code) : std::uint16_t(0)}});
    };
    const std::vector<bool> allowed = edges_between_mixed(mixed, cells);
    for (std::uint32_t edge = 0; edge < edge_count(cells); ++edge) {
        if (!allowed[edge]) continue;
        unsigned first = crossings(edge_ends(cells, edge)[0]);
        const unsigned second = crossings(edge_ends(cells, edge)[1]);
        if (first >= 2) {
            add(edge, 0, true, edge % (first - 1));
            first -= 2;
        }
        if (first >= 1) add(edge, 0, false, first - 1);
        if (second >= 1) add(edge, 1, false, second - 1);
    }
    out.pixels.push_back(std::make_unique<std::vector<std::byte>>(encode_folds(records)));
    return *out.pixels.back();
}

bool same(const ImageView& a, const ImageView& b) {
    if (a.empty() && b.empty()) return true;
    return a.width == b.width && a.height == b.height && a.format == b.format &&
           std::equal(a.bytes.begin(), a.bytes.end(), b.bytes.begin(), b.bytes.end());
}
bool same(const Surface& a, const Surface& b) {
    return same(a.color, b.color) && same(a.depth, b.depth) && same(a.normal, b.normal);
}
bool same(const Layer& a, const Layer& b) { return same(a.outer, b.outer) && same(a.inner, b.inner); }

bool same(const Part& a, const Part& b) {
    using Bits = std::array<std::uint32_t, 8>;
    return a.center == b.center && a.radius == b.radius && a.frame == b.frame && a.mapping == b.mapping &&
           a.node == b.node && a.joint == b.joint && a.to_node == b.to_node &&
           a.center_inside == b.center_inside &&
           std::equal(a.mixed.begin(), a.mixed.end(), b.mixed.begin(), b.mixed.end()) &&
           std::equal(a.folds.begin(), a.folds.end(), b.folds.begin(), b.folds.end()) &&
           std::bit_cast<Bits>(a.errors) == std::bit_cast<Bits>(b.errors) &&
           std::equal(a.layers.begin(), a.layers.end(), b.layers.begin(), b.layers.end(),
                      [](const Layer& x, const Layer& y) { return same(x, y); });
}

} // namespace

TestMap make_map(const std::vector<TestPart>& parts, const std::string& metadata) {
    TestMap out;
    out.map.metadata = metadata;
    for (std::size_t p = 0; p < parts.size(); ++p) {
        const TestPart& spec = parts[p];
        Part part;
        part.center = {1.5 + double(p), -2, 1e-3};
        part.radius = 0.75;
        part.frame = {{{1, 0.25, 0}, {0, -2, 0}, {0, 0.5, 3}}};
        part.mapping = spec.mapping;
        part.node = std::int32_t(p) - 1;
        part.joint = p == 0 ? -1 : 7;
        if (p > 0) part.to_node = {part.frame, {3, -0.5, double(p)}};
        part.center_inside = spec.center_inside;
        part.errors.texel_distance_max = 0.125F;
        part.errors.captured_area = 1;
        const unsigned n = 2 * spec.layers;
        for (unsigned k = 0; k < spec.layers; ++k) {
            Layer layer;
            layer.outer = make_surface(out, spec, 2 * k, n, true);
            if (k + 1 < spec.layers || !spec.solid_core)
                layer.inner = make_surface(out, spec, 2 * k + 1, n, spec.inner_colors);
            part.layers.push_back(layer);
        }
        if (spec.mixed && spec.mapping == Mapping::octahedral) part.mixed = add_mixed(out, spec);
        if (spec.folds && !part.mixed.empty()) part.folds = add_folds(out, spec, part.mixed);
        out.map.parts.push_back(part);
    }
    return out;
}

TestMap make_example() {
    TestMap out;
    const Grid grid{Mapping::octahedral, 3, 3};
    Part part;
    part.center = {0, 1, 0};
    part.radius = 2;
    part.center_inside = true;
    Surface surface;
    surface.depth =
        add_image(out, grid, ElementFormat::u8, [](Vec3d, std::byte* at) { *at = std::byte{255}; });
    surface.normal = add_image(out, grid, ElementFormat::oct8,
                               [](Vec3d u, std::byte* at) { encode_normal(ElementFormat::oct8, u, at); });
    surface.color = add_image(out, grid, ElementFormat::rgba8, [](Vec3d u, std::byte* at) {
        const auto channel = [](double v) { return std::byte(v > 0.5 ? 255 : v < -0.5 ? 127 : 0); };
        at[0] = channel(u.x);
        at[1] = channel(u.y);
        at[2] = channel(u.z);
        at[3] = std::byte{255};
    });
    part.layers.push_back({surface, {}});
    out.map.parts.push_back(part);
    return out;
}

bool same(const SphericalMap& a, const SphericalMap& b) {
    return a.metadata == b.metadata &&
           std::equal(a.parts.begin(), a.parts.end(), b.parts.begin(), b.parts.end(),
                      [](const Part& x, const Part& y) { return same(x, y); });
}

} // namespace spa::test
