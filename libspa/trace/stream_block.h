// SPDX-License-Identifier: Apache-2.0
// The memory of a stream trace: structures of arrays that one block of rays goes through.
//
//   rays ──setup──▶ chords ──stretches──▶ jobs ──walk──▶ results ──finish──▶ hits
//                     └──────────── up to four times, one octant each ────────┘
#pragma once

#include "../../shaders/spa_trace.h"

#include <cstddef>
#include <cstdint>

namespace spa::trace {

// Rays of a block: enough to fill vectors while lanes wait for each other, few enough to stay in the cache.
constexpr std::size_t block_rays = 512;
// Vectors are stored whole.
constexpr std::size_t block_room = block_rays + 64;

template <class T>
struct alignas(64) BlockArray {
    T value[block_room];
    T* operator+(std::size_t i) { return value + i; }
    const T* operator+(std::size_t i) const { return value + i; }
    T& operator[](std::size_t i) { return value[i]; }
    const T& operator[](std::size_t i) const { return value[i]; }
};

using Floats = BlockArray<float>;
using Words = BlockArray<std::uint32_t>;

// Rays that meet the map's sphere (SpaChord), and when they cross the coordinate planes.
struct ChordBlock {
    std::size_t count = 0;
    Words ray; // index in the block
    Floats foot_x, foot_y, foot_z, foot_t, direction_x, direction_y, direction_z;
    Floats cross_x, cross_y, cross_z; // times, clamped to the chord
    Floats time[5];                   // t0, the same times ascending, t1
    Words state; // SPA_OUTSIDE, SPA_INSIDE or SPA_UNKNOWN: what spa_walk takes and leaves
    Words done;  // all bits: nothing more to trace
};

// Stretches to walk (SpaStretch): the jobs of one pass. place: where the walk begins.
struct StretchBlock {
    std::size_t count = 0;
    Words number; // its own index
    Words chord;  // index into the chords
    Floats x0, y0, w0, dx, dy, dw, per_x, per_y, ta, tb;
    Words flip_x, flip_y;
    Words x, y;
    Words lower;            // all bits: z is negative
    Words state;            // where the walk begins
    bool any_state = false; // not all begin outside
};

enum class Found : std::uint32_t {
    surface, // entered by a surface in a pure cell: what finish can fill by vectors
    event,   // anything else in one cell: the text fills it. event + state: of the ray before the cell
};

// What was found, in no particular order.
struct ResultBlock {
    std::size_t count = 0;
    Words job;
    Words found; // Found, or Found::event + state
    Words x, y;  // turned cell
    Floats s0, s1;
    // Of the job, which lies together here.
    Floats x0, y0, w0, dx, dy, dw;
    Words flip_x, flip_y;
};

struct StreamBlock {
    ChordBlock chords;
    StretchBlock stretches;
    ResultBlock results;
};

inline shader::SpaStretch load_stretch(const shader::SpaMap& map, const StretchBlock& jobs, std::size_t job) {
    shader::SpaStretch stretch{};
    stretch.x0 = jobs.x0[job];
    stretch.y0 = jobs.y0[job];
    stretch.w0 = jobs.w0[job];
    stretch.dx = jobs.dx[job];
    stretch.dy = jobs.dy[job];
    stretch.dw = jobs.dw[job];
    stretch.flip_x = jobs.flip_x[job];
    stretch.flip_y = jobs.flip_y[job];
    const auto sign = [&](std::uint32_t flip) { return (flip >> map.levels) != 0 ? -1.0F : 1.0F; };
    stretch.signs = {sign(stretch.flip_x), sign(stretch.flip_y), jobs.lower[job] != 0 ? -1.0F : 1.0F};
    stretch.ta = jobs.ta[job];
    stretch.tb = jobs.tb[job];
    return stretch;
}

} // namespace spa::trace
