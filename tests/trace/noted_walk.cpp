// SPDX-License-Identifier: Apache-2.0
#include "noted_walk.h"

#include "../../shaders/spa_language.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace spa::noted {

using namespace shader; // NOLINT(google-build-using-namespace)

namespace {
std::vector<uint> loads; // places, in order; cleared by whoever wants to look
}

inline uint noted_load(SpaWords words, uint index) {
    loads.push_back(index);
    return words.first[index];
}

} // namespace spa::noted

// The text once more, in a namespace of its own: inline functions of one name must be the same everywhere.
#undef SPA_BEGIN
#define SPA_BEGIN namespace spa::noted {
#define spa_load noted_load
#include "../../shaders/spa_trace.h"
#undef spa_load

namespace spa::test {
namespace {

using namespace noted; // NOLINT(google-build-using-namespace)

SpaRay ray_of(const trace::Ray& ray) {
    return {{ray.origin.x, ray.origin.y, ray.origin.z},
            ray.t_min,
            {ray.direction.x, ray.direction.y, ray.direction.z},
            ray.t_max};
}

// A place or a change of turned cells, as it is on the map. flip: of the stretch.
double unturned(const SpaMap& map, uint flip, double turned) {
    const double side = double(1U << map.levels);
    return (spa_turned(flip) ? side - turned : turned) * ((flip >> map.levels) != 0 ? -1 : 1);
}

// The least W of what stands at a place of a triangle.
float surface_at(const SpaMap& map, const SpaTriangle& tri, float u, float v) {
    float least = SPA_FAR;
    for (uint i = 0; i < spa_prisms(tri); ++i) {
        const SpaPrism prism = spa_prism(map, tri, i);
        bool within = true;
        for (uint n = 0; n < prism.half_planes; ++n)
            within = within && spa_at(spa_load_plane(map, prism.first + 3 * n), u, v) >= 0;
        if (within) least = min(least, spa_at(prism.outer, u, v));
    }
    return least;
}

NotedPlace place_of(const SpaMap& map, const SpaStretch& stretch, double sigma) {
    NotedPlace place;
    place.sigma = sigma;
    const double x = double(stretch.x0) + sigma * double(stretch.dx);
    const double y = double(stretch.y0) + sigma * double(stretch.dy);
    place.x = unturned(map, stretch.flip_x, x);
    place.y = unturned(map, stretch.flip_y, y);
    place.w = double(stretch.w0) + sigma * double(stretch.dw);
    const uint last = (1U << map.levels) - 1U;
    const uint cell_x = std::min(uint(std::abs(place.x)), last);
    const uint cell_y = std::min(uint(std::abs(place.y)), last);
    const float u = float(std::abs(place.x) - cell_x);
    const float v = float(std::abs(place.y) - cell_y);
    const uint on_map_x = cell_x | (stretch.flip_x & (last + 1U));
    const uint on_map_y = cell_y | (stretch.flip_y & (last + 1U));
    const SpaTriangle tri = spa_triangle(map, on_map_x, on_map_y, u + v > 1.0F ? 1U : 0U);
    place.surface = double(surface_at(map, tri, u, v));
    return place;
}

// The node that lies at an index of the nodes.
NotedNode node_at(const SpaMap& map, const SpaStretch& stretch, uint index, uint& level) {
    uint bits = 0;
    while (index >= spa_node(bits + 1, 0, 0)) ++bits;
    level = map.levels - bits;
    const uint in_level = index - spa_node(bits, 0, 0);
    const uint row = in_level >> (bits + 1);
    const uint column = in_level & ((2U << bits) - 1U);
    const auto range = [&](uint place, double& low, double& high) {
        const uint side = 1U << bits;
        const double sign = place >= side ? -1 : 1;
        const double size = double(1U << level);
        const double a = sign * (place & (side - 1)) * size;
        const double b = a + sign * size;
        low = std::min(a, b);
        high = std::max(a, b);
    };
    NotedNode node;
    range(column, node.x0, node.x1);
    range(row, node.y0, node.y1);
    node.w = spa_float(map.words.first[map.nodes + index]);
    // Where the ray is in it.
    const NotedPlace begin = place_of(map, stretch, 0);
    const NotedPlace end = place_of(map, stretch, 1);
    node.sigma1 = 1;
    const auto clip = [&](double from, double to, double low, double high) {
        if (from == to) return;
        const double a = (low - from) / (to - from);
        const double b = (high - from) / (to - from);
        node.sigma0 = std::max(node.sigma0, std::min(a, b));
        node.sigma1 = std::min(node.sigma1, std::max(a, b));
    };
    clip(begin.x, end.x, node.x0, node.x1);
    clip(begin.y, end.y, node.y0, node.y1);
    return node;
}

// What spa_walk has loaded, as nodes.
std::vector<NotedNode> nodes_of(const SpaMap& map, const SpaStretch& stretch, const std::vector<uint>& loaded,
                                bool hit) {
    const uint count = spa_node(map.levels + 1, 0, 0);
    std::vector<NotedNode> nodes;
    nodes.reserve(loaded.size());
    uint level_before = 0;
    for (const uint place : loaded) {
        if (place >= map.nodes && place < map.nodes + count) {
            uint level = 0;
            const NotedNode node = node_at(map, stretch, place - map.nodes, level);
            // Only from a node that it opens does the walk come to a lower level.
            if (!nodes.empty() && level < level_before) nodes.back().visit = Visit::opened;
            nodes.push_back(node);
            level_before = level;
        } else if (!nodes.empty() && place >= map.samples) {
            // What stands in a cell is loaded before the next node.
            nodes.back().visit = Visit::cell;
        }
    }
    if (hit && !nodes.empty()) nodes.back().visit = Visit::hit;
    return nodes;
}

} // namespace

NotedWalk note_walk(std::span<const std::uint32_t> words, const trace::Ray& traced) {
    const SpaMap map = spa_open({words.data()});
    const SpaRay ray = ray_of(traced);
    NotedWalk result;
    // The beginning of spa_trace_projective.
    SpaChord chord;
    if (!spa_chord(ray, map.radius, chord)) return result;
    const float3 direction = ray.direction;
    const float3 per(1 / direction.x, 1 / direction.y, 1 / direction.z);
    if (!spa_in_box(map, direction, per, chord)) return result;
    const float3 crossings(spa_crossing(chord.foot.x, direction.x, per.x, chord.t0, chord.t1),
                           spa_crossing(chord.foot.y, direction.y, per.y, chord.t0, chord.t1),
                           spa_crossing(chord.foot.z, direction.z, per.z, chord.t0, chord.t1));
    std::array<float, 5> times{chord.t0, crossings.x, crossings.y, crossings.z, chord.t1};
    std::sort(times.begin() + 1, times.end() - 1);
    uint state = chord.starts_inside_sphere ? SPA_UNKNOWN : SPA_OUTSIDE;
    SpaEvent event = spa_no_event();
    SpaPiece piece{};
    SpaTriangle tri{};
    SpaWalk walk{};
    for (std::size_t i = 0; i + 1 < times.size() && !result.hit; ++i) {
        SpaStretch stretch;
        if (!(times[i] < times[i + 1]) ||
            !spa_stretch(map, chord.foot, direction, crossings, times[i], times[i + 1], stretch))
            continue;
        loads.clear();
        result.hit = spa_walk(map, stretch, 0, state, event, piece, tri, walk);
        NotedStretch& noted = result.stretches.emplace_back();
        noted.nodes = nodes_of(map, stretch, std::exchange(loads, {}), result.hit);
        constexpr int parts = 1000;
        for (int k = 0; k <= parts; ++k) noted.places.push_back(place_of(map, stretch, double(k) / parts));
        if (result.hit) result.at = place_of(map, stretch, double(event.s));
    }
    return result;
}

NotedLoads note_loads(std::span<const std::uint32_t> words, const trace::Ray& ray) {
    const SpaMap map = spa_open({words.data()});
    loads.clear();
    SpaHit hit;
    NotedLoads result;
    result.hit = spa_trace_projective(map, ray_of(ray), 0, hit);
    const auto within = [](uint place, uint first, uint end) {
        return first != 0 && place >= first && place < end;
    };
    const uint before_samples = map.samples;
    const uint after_samples = map.cells != 0 ? map.cells : map.depths;
    for (const uint place : loads) {
        if (within(place, map.nodes, map.cores != 0 ? map.cores : before_samples)) ++result.nodes;
        if (within(place, map.cores, before_samples)) ++result.cores;
        if (within(place, map.samples, after_samples)) ++result.samples;
        if (within(place, map.cells, map.prisms)) ++result.cells;
        if (within(place, map.prisms, map.depths)) ++result.prisms;
    }
    return result;
}

} // namespace spa::test
