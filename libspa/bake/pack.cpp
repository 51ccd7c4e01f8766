// SPDX-License-Identifier: Apache-2.0
#include "pack.h"

#include "color_image.h"
#include "sample_directions.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstring>

namespace spa::bake {
namespace {

ImageView store(OwnedMap& map, const Grid& grid, ElementFormat format) {
    const std::size_t bytes = std::size_t(grid.width) * grid.height * element_size(format);
    map.pixels.push_back(std::make_unique<std::byte[]>(bytes));
    return {{map.pixels.back().get(), bytes}, grid.width, grid.height, format};
}

template <class Encode>
ImageView encode_image(OwnedMap& map, const Grid& grid, ElementFormat format, Encode&& encode) {
    const ImageView view = store(map, grid, format);
    std::byte* const out = map.pixels.back().get();
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, std::size_t(grid.width) * grid.height, 4096),
                      [&](const auto& range) {
                          for (std::size_t i = range.begin(); i < range.end(); ++i) {
                              encode(i, out + i * element_size(format));
                          }
                      });
    return view;
}

std::span<const std::byte> keep(const std::vector<std::byte>& bytes, OwnedMap& map) {
    map.pixels.push_back(std::make_unique<std::byte[]>(bytes.size()));
    std::copy(bytes.begin(), bytes.end(), map.pixels.back().get());
    return {map.pixels.back().get(), bytes.size()};
}

bool has_points(const std::vector<SurfacePoint>& surface) {
    return std::any_of(surface.begin(), surface.end(), [](const SurfacePoint& p) { return p.radius > 0; });
}

Surface pack_surface(const std::vector<SurfacePoint>& shape, const Grid& shape_grid,
                     const std::vector<SurfacePoint>& color, const Options& options, OwnedMap& map) {
    Surface surface;
    surface.depth = encode_image(map, shape_grid, options.depth, [&](std::size_t i, std::byte* out) {
        if (shape[i].radius > 0) encode_depth(options.depth, double(shape[i].radius), out);
    });
    surface.normal = encode_image(map, shape_grid, options.normals, [&](std::size_t i, std::byte* out) {
        if (shape[i].radius > 0) encode_normal(options.normals, to_double(shape[i].normal), out);
    });
    std::vector<Rgba8> pixels = filter_color(color, options.color_grid, options.samples);
    dilate_color(pixels, options.color_grid, color_dilation);
    surface.color = store(map, options.color_grid, ElementFormat::rgba8);
    std::memcpy(map.pixels.back().get(), pixels.data(), pixels.size() * sizeof(Rgba8));
    return surface;
}

} // namespace

void pack_layers(const SurfaceGrid& shape, const SurfaceGrid& color, const Options& options, Part& part,
                 OwnedMap& map) {
    const auto pack = [&](std::size_t index) {
        return pack_surface(shape.surfaces[index], shape.grid, color.surfaces[index], options, map);
    };
    for (std::size_t outer = 0; outer < shape.surfaces.size(); outer += 2) {
        if (outer > 0 && !has_points(shape.surfaces[outer])) break;
        Layer layer;
        layer.outer = pack(outer);
        if (outer + 1 < shape.surfaces.size() && has_points(shape.surfaces[outer + 1]))
            layer.inner = pack(outer + 1);
        part.layers.push_back(layer);
    }
}

void pack_mixed(const std::vector<std::byte>& mixed, Part& part, OwnedMap& map) {
    part.mixed = keep(mixed, map);
}

void pack_folds(const std::vector<FoldRecord>& records, Part& part, OwnedMap& map) {
    if (!records.empty()) part.folds = keep(encode_folds(records), map);
}

double coverage(const std::vector<SurfacePoint>& surface, const Grid& grid) {
    const SampleDirections directions(grid);
    double covered = 0;
    double total = 0;
    for (std::uint32_t y = 0; y < grid.height; ++y) {
        for (std::uint32_t x = 0; x < grid.width; ++x) {
            const double angle = directions.solid_angle_of({x, y});
            total += angle;
            if (surface[std::size_t(y) * grid.width + x].radius > 0) covered += angle;
        }
    }
    return covered / total;
}

} // namespace spa::bake
