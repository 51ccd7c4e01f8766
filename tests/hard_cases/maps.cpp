// SPDX-License-Identifier: Apache-2.0
#include "maps.h"

#include "fold_maps.h"

#include "../../libspa/bake/bake.h"
#include "../../samples/samples.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <utility>

namespace spa::test {
namespace {

using Generator = std::mt19937_64;

double uniform(Generator& random) { return std::uniform_real_distribution<double>(0, 1)(random); }

Vec3d random_direction(Generator& random) {
    std::normal_distribution<double> normal;
    const double x = normal(random);
    const double y = normal(random);
    return normalize(Vec3d{x, y, normal(random)});
}

ImageView add_image(OwnedPart& owned, const Grid& grid, ElementFormat format) {
    const std::size_t bytes = std::size_t(grid.width) * grid.height * element_size(format);
    owned.pixels.push_back(std::make_unique<std::byte[]>(bytes));
    return {{owned.pixels.back().get(), bytes}, grid.width, grid.height, format};
}

std::byte* element(const ImageView& image, const OwnedPart& owned, TexelIndex at) {
    for (const auto& pixels : owned.pixels)
        if (pixels.get() == image.bytes.data())
            return pixels.get() + (std::size_t(at.y) * image.width + at.x) * element_size(image.format);
    return nullptr;
}

void mark_mixed(OwnedPart& owned, const MadePart& made) {
    if (made.mixed_share <= 0) return;
    const std::size_t bits = 2 * std::size_t(made.cells) * made.cells;
    const std::size_t bytes = (bits + 7) / 8;
    owned.pixels.push_back(std::make_unique<std::byte[]>(bytes));
    std::byte* const mixed = owned.pixels.back().get();
    Generator random(made.seed + 77);
    for (std::size_t i = 0; i < bits; ++i)
        if (uniform(random) < made.mixed_share) mixed[i / 8] |= std::byte(1U << (i % 8));
    owned.part.mixed = {mixed, bytes};
}

} // namespace

OwnedPart make_part(const MadePart& made, const MakeIntervals& intervals) {
    OwnedPart owned;
    Part& part = owned.part;
    const Grid grid{Mapping::octahedral, made.cells + 1, made.cells + 1};
    part.mapping = Mapping::octahedral;
    part.center_inside = made.center_inside;
    for (std::uint32_t k = 0; k < made.layers; ++k) {
        Layer& layer = part.layers.emplace_back();
        for (Surface* surface : {&layer.outer, &layer.inner}) {
            surface->depth = add_image(owned, grid, made.depth);
            if (surface == &layer.outer || made.inner_normals)
                surface->normal = add_image(owned, grid, made.normal);
        }
    }
    const std::size_t depth_size = element_size(made.depth);
    for (std::uint32_t y = 0; y < grid.height; ++y) {
        for (std::uint32_t x = 0; x < grid.width; ++x) {
            const TexelIndex at{x, y};
            const TexelIndex same = canonical(grid, at);
            const std::vector<MadeInterval> found =
                same == at ? intervals(sample_direction(grid, at)) : std::vector<MadeInterval>{};
            for (std::uint32_t k = 0; k < made.layers; ++k) {
                Layer& layer = part.layers[k];
                for (Surface* surface : {&layer.outer, &layer.inner}) {
                    std::byte* const depth = element(surface->depth, owned, at);
                    std::byte* const normal =
                        surface->normal.empty() ? nullptr : element(surface->normal, owned, at);
                    if (same != at) {
                        std::copy_n(element(surface->depth, owned, same), depth_size, depth);
                        if (normal != nullptr)
                            std::copy_n(element(surface->normal, owned, same), element_size(made.normal),
                                        normal);
                        continue;
                    }
                    const bool outer = surface == &layer.outer;
                    const double d = k >= found.size() ? 0 : outer ? found[k].outer : found[k].inner;
                    if (d > 0) encode_depth(made.depth, d, depth);
                    if (normal != nullptr && d > 0)
                        encode_normal(made.normal, outer ? found[k].outer_normal : found[k].inner_normal,
                                      normal);
                }
            }
        }
    }
    mark_mixed(owned, made);
    return owned;
}

OwnedPart random_part(const MadePart& made) {
    Generator random(made.seed);
    const double holes = std::max(0.0, uniform(random) * 0.5 - 0.15);
    const double cores = uniform(random);
    const double roughness = uniform(random);
    const double variety = uniform(random); // of how many intervals there are, and whether they end
    const bool usual_core = uniform(random) < 0.5;
    return make_part(made, [&](Vec3d g) {
        std::vector<MadeInterval> found;
        if (uniform(random) < holes) return found;
        const bool varied = uniform(random) < variety;
        const std::size_t count =
            varied ? 1 + std::size_t(uniform(random) * made.layers) : std::size_t(made.layers);
        // Some intervals of no thickness, and some that touch the next.
        std::vector<double> depths;
        double smooth = 0.9;
        for (std::size_t i = 0; i < 2 * count; ++i) {
            const double down = uniform(random) * roughness * 0.9 + (1 - roughness) * 0.2;
            if (uniform(random) > 0.05) smooth *= 1 - down;
            depths.push_back(smooth);
        }
        for (std::size_t k = 0; k < count; ++k) {
            MadeInterval interval{depths[2 * k], depths[2 * k + 1], random_direction(random),
                                  random_direction(random)};
            if (uniform(random) < 0.7) interval.outer_normal = normalize(g + interval.outer_normal * 0.5);
            if (uniform(random) < 0.7)
                interval.inner_normal = normalize(g * -1.0 + interval.inner_normal * 0.5);
            if (k + 1 == count && (varied ? uniform(random) < cores : usual_core)) interval.inner = 0;
            found.push_back(interval);
        }
        return found;
    });
}

OwnedPart baked_part(const BakedPart& baked) {
    bake::Options options;
    options.grid = {Mapping::octahedral, baked.cells + 1, baked.cells + 1};
    if (baked.mapping == Mapping::latlong) options.grid = {Mapping::latlong, 2 * baked.cells, baked.cells};
    options.color_grid = options.grid;
    options.layers = baked.layers;
    options.depth = baked.depth;
    bake::Result result = bake::bake_model(samples::make_sample(baked.sample, baked.level), options);
    return {std::move(result.map.map.parts.front()), std::move(result.map.pixels)};
}

std::vector<NamedPart> attacked_parts() {
    using enum ElementFormat;
    std::vector<NamedPart> parts;
    const auto bumpy = [](double amount) {
        return [amount](Vec3d g) {
            const Vec3d u = normalize(g);
            const double r = 0.7 + amount * std::sin(7 * u.x + 1) * std::cos(6 * u.y - 2) * std::sin(5 * u.z);
            return std::vector<MadeInterval>{{r, 0, u, {}}};
        };
    };
    parts.push_back({"sphere 32 u16", baked_part({.sample = "sphere"})});
    parts.push_back({"bumpy 24 f32", make_part({.cells = 24}, bumpy(0.25))});
    parts.push_back(
        {"bumpy mixed 16 u16", make_part({.cells = 16, .depth = u16, .mixed_share = 0.3}, bumpy(0.2))});
    parts.push_back({"cube 32 u16", baked_part({.sample = "cube"})});
    parts.push_back({"torus 32 u16, 2 layers", baked_part({.sample = "torus", .layers = 2})});
    parts.push_back({"boot 32 u16, 1 layer", baked_part({.sample = "boot"})});
    parts.push_back({"boot 32 u16, 2 layers", baked_part({.sample = "boot", .layers = 2})});
    parts.push_back(
        {"spiky 24 u8, 2 layers", baked_part({.sample = "spiky", .cells = 24, .layers = 2, .depth = u8})});
    parts.push_back({"concave 32 f32, 3 layers",
                     baked_part({.sample = "concave", .cells = 32, .layers = 3, .depth = f32})});
    parts.push_back({"bumpy 2 f32", make_part({.cells = 2}, bumpy(0.2))});
    parts.push_back({"random 2 u8, 2 layers",
                     random_part({.cells = 2, .layers = 2, .depth = u8, .normal = rgb8, .seed = 5})});
    parts.push_back(
        {"random 4 u16, 2 layers",
         random_part(
             {.cells = 4, .layers = 2, .depth = u16, .mixed_share = 0.2, .center_inside = true, .seed = 6})});
    parts.push_back(
        {"random 6 u8, 1 layer", random_part({.cells = 6, .depth = u8, .normal = oct8, .seed = 7})});
    parts.push_back({"random 10 u16, 2 layers",
                     random_part({.cells = 10, .layers = 2, .depth = u16, .mixed_share = 0.1, .seed = 8})});
    parts.push_back({"random 24 f32, 3 layers", random_part({.cells = 24,
                                                             .layers = 3,
                                                             .inner_normals = false,
                                                             .mixed_share = 0.1,
                                                             .center_inside = true,
                                                             .seed = 9})});
    for (auto* const folded : {made_fold_parts, random_fold_parts, baked_fold_parts})
        for (NamedPart& part : folded()) parts.push_back(std::move(part));
    return parts;
}

} // namespace spa::test
