// SPDX-License-Identifier: Apache-2.0
// Streams of rays: blocks go through the steps of stream_block.h, compiled once for each instruction set by
// Highway.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "libspa/trace/stream.cpp"
// Vectors are members of structs here, which those without a fixed length cannot be.
// SSSE3 nobody has without SSE4.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV | HWY_SSSE3)
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "stream_finish-inl.h"
#include "stream_setup-inl.h"
#include "stream_walk-inl.h"

#include "convert.h"
#include "trace.h"

#include <algorithm>
#include <cstring>

HWY_BEFORE_NAMESPACE();
namespace spa::trace::HWY_NAMESPACE {

// What is done with what is found.
struct HitSink {
    static constexpr bool wants_record = true;
    Hit* hits;

    void clear(std::size_t count) const { std::fill_n(hits, count, Hit{}); }
    void put(std::size_t ray, const HitBlock& found, std::size_t lane) const {
        Hit& hit = hits[ray];
        hit.t = found.t[lane];
        hit.normal = {found.normal_x[lane], found.normal_y[lane], found.normal_z[lane]};
        hit.map = {found.map_x[lane], found.map_y[lane]};
        hit.layer = found.layer[lane];
        hit.side = found.inner[lane] != 0 ? HitSide::inner : HitSide::outer;
    }
};

struct OcclusionSink {
    static constexpr bool wants_record = false;
    std::uint8_t* blocked;

    void clear(std::size_t count) const { std::fill_n(blocked, count, std::uint8_t(0)); }
    void put(std::size_t ray) const { blocked[ray] = 1; }
};

// What is not a plain hit on a pure cell: the text looks at the one cell again.
template <class Sink>
void finish_by_text(const TraceMap& map, const StreamBlock& block, std::size_t result, const Ray* rays,
                    std::uint32_t flags, const Sink& sink) {
    const ResultBlock& results = block.results;
    const std::size_t job = results.job[result];
    const std::size_t chord = block.stretches.chord[job];
    const std::size_t ray = block.chords.ray[chord];
    if constexpr (Sink::wants_record) {
        const shader::SpaStretch stretch = load_stretch(map.map(), block.stretches, job);
        shader::SpaEvent event = shader::spa_no_event();
        shader::SpaPiece piece{};
        shader::SpaTriangle tri{};
        const bool from_outside = Found(results.found[result]) == Found::surface;
        shader::uint state = from_outside ? SPA_OUTSIDE : results.found[result] - std::uint32_t(Found::event);
        shader::spa_cross_cell(map.map(), stretch, results.x[result], results.y[result], results.s0[result],
                               results.s1[result], flags, state, event, piece, tri);
        const ChordBlock& chords = block.chords;
        shader::SpaChord of_ray{};
        of_ray.foot = {chords.foot_x[chord], chords.foot_y[chord], chords.foot_z[chord]};
        of_ray.foot_t = chords.foot_t[chord];
        sink.hits[ray] = to_hit(shader::spa_finish(map.map(), to_shader(rays[ray]), of_ray, stretch, event,
                                                   piece, tri, results.x[result], results.y[result]));
    } else {
        sink.put(ray);
    }
}

template <bool with_inner, class Sink>
void finish_pass(const TraceMap& map, StreamBlock& block, const Ray* rays, std::uint32_t flags,
                 const Sink& sink) {
    const std::size_t lane_count = hn::Lanes(du);
    const ResultBlock& results = block.results;
    HitBlock hits{};
    for (std::size_t first = 0; first < results.count; first += lane_count) {
        if constexpr (Sink::wants_record) finish<with_inner>(map.map(), block, rays, first, hits);
        const std::size_t last = std::min(first + lane_count, results.count);
        for (std::size_t result = first; result < last; ++result) {
            const std::size_t chord = block.stretches.chord[results.job[result]];
            block.chords.done[chord] = UINT32_MAX;
            if constexpr (Sink::wants_record) {
                if (Found(results.found[result]) == Found::surface && hits.by_text[result - first] == 0) {
                    sink.put(block.chords.ray[chord], hits, result - first);
                    continue;
                }
            }
            finish_by_text(map, block, result, rays, flags, sink);
        }
    }
}

template <bool with_inner, class Sink>
void trace_blocks(const TraceMap& map, const Ray* rays, std::size_t count, std::uint32_t flags, Sink sink) {
    StreamBlock block;
    for (std::size_t first = 0; first < count; first += block_rays) {
        const std::size_t n = std::min(count - first, block_rays);
        sink.clear(n);
        find_chords(map.map(), rays + first, n, block.chords);
        for (std::size_t pass = 0; pass < 4; ++pass) {
            find_stretches(map.map(), pass, block.chords, block.stretches);
            if (block.stretches.count == 0) continue;
            walk<with_inner>(map.map(), flags, block);
            finish_pass<with_inner>(map, block, rays + first, flags, sink);
        }
        if constexpr (Sink::wants_record)
            sink.hits += n;
        else
            sink.blocked += n;
    }
}

void hits_of_stream(const TraceMap& map, const Ray* rays, std::size_t count, std::uint32_t flags, Hit* hits) {
    if (map.map().surfaces == 1)
        trace_blocks<false>(map, rays, count, flags, HitSink{hits});
    else
        trace_blocks<true>(map, rays, count, flags, HitSink{hits});
}

void occlusion_of_stream(const TraceMap& map, const Ray* rays, std::size_t count, std::uint32_t flags,
                         std::uint8_t* blocked) {
    if (map.map().surfaces == 1)
        trace_blocks<false>(map, rays, count, flags, OcclusionSink{blocked});
    else
        trace_blocks<true>(map, rays, count, flags, OcclusionSink{blocked});
}

const char* target_name() { return hwy::TargetName(HWY_TARGET); }

} // namespace spa::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace spa::trace {

HWY_EXPORT(hits_of_stream);
HWY_EXPORT(occlusion_of_stream);
HWY_EXPORT(target_name);

void closest_hits(const TraceMap& map, std::span<const Ray> rays, std::uint32_t flags, std::span<Hit> hits) {
    if (map.map().mapping != SPA_OCTAHEDRAL) {
        std::fill(hits.begin(), hits.end(), Hit{});
        return;
    }
    HWY_DYNAMIC_DISPATCH(hits_of_stream)(map, rays.data(), rays.size(), flags, hits.data());
}

void occluded(const TraceMap& map, std::span<const Ray> rays, std::uint32_t flags,
              std::span<std::uint8_t> blocked) {
    if (map.map().mapping != SPA_OCTAHEDRAL) {
        std::fill(blocked.begin(), blocked.end(), std::uint8_t(0));
        return;
    }
    HWY_DYNAMIC_DISPATCH(occlusion_of_stream)(map, rays.data(), rays.size(), flags, blocked.data());
}

const char* stream_target() { return HWY_DYNAMIC_DISPATCH(target_name)(); }

} // namespace spa::trace
#endif
