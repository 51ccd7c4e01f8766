// SPDX-License-Identifier: Apache-2.0
#include "trace_map.h"

#include "map_images.h"
#include "map_surface.h"
#include "node_pyramid.h"

#include "../../shaders/spa_cell.h"

#include "../core/error.h"

#include <algorithm>
#include <array>
#include <bit>
#include <string>

namespace spa::trace {
namespace {

constexpr std::uint32_t max_side = (1U << 14U) + 1;

void check_size(const Part& part) {
    const ImageView& depth = part.layers.front().outer.depth;
    if (depth.width > max_side || depth.height > max_side)
        throw Error(ExitCode::unsupported,
                    "a map of " + std::to_string(depth.width) + " x " + std::to_string(depth.height) +
                        " samples is too large to trace; bake it with at most 16384 cells a side");
}

// A prism has ten bits for each of its layers.
void check_layers(const MapSamples& samples) {
    if (samples.layers() > SPA_MAX_LAYERS)
        throw Error(ExitCode::unsupported, "a map of " + std::to_string(samples.layers()) +
                                               " layers has too many to trace; bake it with at most " +
                                               std::to_string(SPA_MAX_LAYERS));
}

void check_length(std::size_t words) {
    if (words > UINT32_MAX)
        throw Error(ExitCode::unsupported,
                    "this map is too large to trace: its trace image would have 2^32 words");
}

// Appends words and says where they are.
std::uint32_t append(std::vector<std::uint32_t>& words, std::span<const std::uint32_t> more) {
    check_length(words.size() + more.size());
    const auto place = std::uint32_t(words.size());
    words.insert(words.end(), more.begin(), more.end());
    return place;
}

std::uint32_t bits(float value) { return std::bit_cast<std::uint32_t>(value); }

std::vector<std::uint32_t> patterns(std::span<const float> values) {
    std::vector<std::uint32_t> words(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) words[i] = bits(values[i]);
    return words;
}

// Beyond which w rays are not followed, in units of the greatest w (docs/tracing.md, "The core").
constexpr float uniform_core = 2, mixed_core = 64;

// Rays that come from the core may pass an outer end by what rounding adds there (SPA_ROUNDING) before they
// have left it: radius and box must not end them earlier.
void widen(MapCells& cells, float w_core) {
    const float margin = cells.radius * std::min(2 * SPA_ROUNDING * w_core * cells.radius, 0.5F);
    cells.radius += margin;
    cells.box_low = cells.box_low - Vec3f{margin, margin, margin};
    cells.box_high = cells.box_high + Vec3f{margin, margin, margin};
}

// Gives back TraceMap::tangent_share().
double add_cells(const Part& part, const MapSamples& samples, std::vector<std::uint32_t>& words) {
    MapCells cells = find_cells(part, samples);
    const float w_core = cells.w_max * (cells.uniform_core ? uniform_core : mixed_core);
    widen(cells, w_core);
    const NodePyramid pyramid = build_pyramid(cells, w_core, samples.surfaces > 1 ? 2 : 1);
    words[SPA_HEADER_RADIUS] = bits(cells.radius);
    const std::array<float, 6> box{cells.box_low.x,  cells.box_low.y,  cells.box_low.z,
                                   cells.box_high.x, cells.box_high.y, cells.box_high.z};
    for (std::size_t i = 0; i < box.size(); ++i) words[SPA_HEADER_BOX + i] = bits(box[i]);
    words[SPA_HEADER_FLAGS] = pyramid.words == 2 ? SPA_MAP_TWO_RANGES : 0;
    words[SPA_HEADER_LEVELS] = cells.levels;
    words[SPA_HEADER_CODE_BASE] = pyramid.code_base;
    words[SPA_HEADER_CODE_SHIFT] = pyramid.code_shift;
    words[SPA_HEADER_W_CORE] = bits(w_core);
    words[SPA_HEADER_NODES] = append(words, pyramid.nodes);
    if (!pyramid.cores.empty()) words[SPA_HEADER_CORES] = append(words, patterns(pyramid.cores));
    words[SPA_HEADER_SAMPLES] = append(words, patterns(samples.w));
    if (cells.cells.empty()) return 0;
    const auto lists = std::uint32_t(words.size() + cells.cells.size());
    std::vector<std::uint32_t> places = cells.cells;
    for (std::uint32_t& place : places)
        if (place > SPA_CELL_LAYERS) place += lists;
    words[SPA_HEADER_CELLS] = append(words, places);
    words[SPA_HEADER_PRISMS] = append(words, cells.lists);
    for (const std::uint32_t place : cells.places) words[lists + place] += lists;
    const std::size_t mixed = cells.fold_triangles + cells.tangent_triangles;
    return mixed == 0 ? 0 : double(cells.tangent_triangles) / double(mixed);
}

} // namespace

TraceMap::TraceMap(const Part& part, const CompileOptions& options) {
    check_size(part);
    const ImageView& depth = part.layers.front().outer.depth;
    const MapSamples samples = read_samples(part, options.layers);
    check_layers(samples);
    std::vector<std::uint32_t>& words = words_;
    words.assign(SPA_HEADER_WORDS, 0);
    words[SPA_HEADER_MAGIC] = SPA_MAGIC;
    words[SPA_HEADER_MAPPING] = std::uint32_t(part.mapping);
    words[SPA_HEADER_WIDTH] = depth.width;
    words[SPA_HEADER_HEIGHT] = depth.height;
    words[SPA_HEADER_SURFACES] = samples.surfaces;
    words[SPA_HEADER_RADIUS] = bits(1.0F);
    if (part.mapping == Mapping::octahedral) tangent_share_ = add_cells(part, samples, words);
    words[SPA_HEADER_DEPTHS] = append(words, patterns(samples.depth));
    const std::vector<std::uint32_t> no_table(std::size_t(samples.surfaces) * SPA_IMAGE_WORDS, 0);
    words[SPA_HEADER_IMAGES] = append(words, no_table);
    words[SPA_HEADER_LENGTH] = std::uint32_t(words.size());
    if (options.images) {
        std::vector<std::uint32_t> with_images(size_with_images(part));
        write_with_images(part, with_images);
        words_.swap(with_images);
    }
    words_.shrink_to_fit();
    map_ = shader::spa_open(shader::SpaWords{words_.data()});
}

std::size_t TraceMap::size_with_images(const Part& part) const {
    const std::size_t size = words_.size() + image_words(part, words_[SPA_HEADER_SURFACES]);
    check_length(size);
    return size;
}

void TraceMap::write_with_images(const Part& part, std::span<std::uint32_t> words) const {
    const std::uint32_t table_place = words_[SPA_HEADER_IMAGES];
    const auto first = std::uint32_t(words_.size());
    const std::vector<std::uint32_t> table =
        write_images(part, words_[SPA_HEADER_SURFACES], first, words.subspan(first));
    std::copy(words_.begin(), words_.begin() + table_place, words.begin());
    std::copy(table.begin(), table.end(), words.begin() + table_place);
    words[SPA_HEADER_LENGTH] = std::uint32_t(words.size());
}

std::size_t TraceMap::projective_bytes() const { return part_of_image(SPA_HEADER_DEPTHS, SPA_HEADER_NODES); }

std::size_t TraceMap::depth_bytes() const { return part_of_image(SPA_HEADER_IMAGES, SPA_HEADER_DEPTHS); }

// Bytes from one place of the header to another; 0 where the first is not there.
std::size_t TraceMap::part_of_image(std::uint32_t to, std::uint32_t from) const {
    return words_[from] == 0 ? 0 : (std::size_t(words_[to]) - words_[from]) * sizeof(std::uint32_t);
}

} // namespace spa::trace
