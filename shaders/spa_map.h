// SPDX-License-Identifier: Apache-2.0
// The trace image: what a tracer reads of one part, as an array of 32-bit words. The header comes first; all
// places are indices of words from the header's first, so an image may lie anywhere.
//
//   nodes      bounds of the surface, a pyramid over each quadrant of the octahedral map (spa_projective.h)
//   cores      for each node the W beyond which everything below it is solid; SPA_FAR: there is none
//   samples    W of every sample and surface: 1/|q|_1 of the stored point q (map space); SPA_FAR = none;
//              as an inner end: the centre is reached. Plane by plane: outer 0, inner 0, outer 1, ...
//   cells      one word a cell, in the order of the nodes' last level: SPA_CELL_PURE, SPA_CELL_LAYERS, or
//   where
//              its two lists are
//   prisms     what stands in mixed triangles, and for each triangle of such a cell its list (SPA_LIST_WORDS)
//   depths     r/R of the outermost surface, one float a sample: what fan and march read
//   images     colours and normals of every surface
#ifndef SPA_MAP_H
#define SPA_MAP_H

#include "spa_language.h"

SPA_BEGIN

// Beyond any W: no surface; or, as an inner end, solid to the centre.
#define SPA_FAR 1e30f

// Words of the header.
#define SPA_HEADER_MAGIC 0u     // SPA_MAGIC
#define SPA_HEADER_LENGTH 1u    // words of the image
#define SPA_HEADER_MAPPING 2u   // SPA_LATLONG or SPA_OCTAHEDRAL
#define SPA_HEADER_WIDTH 3u     // samples of a row
#define SPA_HEADER_HEIGHT 4u    // rows
#define SPA_HEADER_SURFACES 5u  // 1, or 2 * layers: outer and inner of each
#define SPA_HEADER_FLAGS 6u     // SPA_MAP_...
#define SPA_HEADER_RADIUS 7u    // float: no stored point is farther from the centre
#define SPA_HEADER_LEVELS 8u    // octahedral: a quadrant has 2^levels x 2^levels cells, padding included
#define SPA_HEADER_CODE_BASE 9u // a node's code c stands for the float of pattern base + (c << shift)
#define SPA_HEADER_CODE_SHIFT 10u
#define SPA_HEADER_W_CORE 11u // float: rays are not followed beyond this W
#define SPA_HEADER_NODES 12u
#define SPA_HEADER_SAMPLES 13u
#define SPA_HEADER_CELLS 14u // 0: all cells are SPA_CELL_PURE
#define SPA_HEADER_PRISMS 15u
#define SPA_HEADER_DEPTHS 16u
#define SPA_HEADER_IMAGES 17u // SPA_IMAGE_WORDS words a surface

#define SPA_HEADER_BOX 18u // 6 floats: the box around the stored surface, lowest x, y, z, highest x, y, z

#define SPA_HEADER_CORES 24u // 0: there are none

#define SPA_HEADER_WORDS 25u
#define SPA_MAGIC 0x54415053u // "SPAT"

#define SPA_LATLONG 1u
#define SPA_OCTAHEDRAL 2u

// Nodes hold two ranges of W, two words of two codes each. Without it everything solid reaches the centre,
// and a node is one word, the float at which it begins.
#define SPA_MAP_TWO_RANGES 1u

// For each surface: where its colours (rgba8) are, their width and height, and the same of the normals (two
// snorm16, octahedral). Width 0: there is no such image.
#define SPA_IMAGE_WORDS 6u

// Words of cells: both triangles are pure, with no interval but that of layer 0; or with more.
#define SPA_CELL_PURE 0u
#define SPA_CELL_LAYERS 1u

// In place of a normal: no surface there.
#define SPA_NO_NORMAL 0x80008000u

// Flags of a trace.
#define SPA_CULL_BACK 1u  // hits from inside the solid are passed over
#define SPA_CULL_FRONT 2u // hits from outside are
#define SPA_ANY_HIT 4u    // whether there is a hit is all that is asked: of the record only t is filled

// Sides of a hit.
#define SPA_OUTER 0u
#define SPA_INNER 1u
#define SPA_WALL 2u // the step between neighbouring samples that see different surfaces

// Map space. Points of the ray: origin + t * direction, t_min <= t <= t_max.
struct SpaRay {
    float3 origin;
    float t_min;
    float3 direction;
    float t_max;
};

struct SpaHit {
    float t;       // along the direction as given
    float2 map;    // place on the map, in [0,1] x [0,1]: from the left and from the top
    float3 normal; // geometric, of any length > 0, out of the solid
    uint layer;
    uint side;  // SPA_OUTER, SPA_INNER or SPA_WALL
    uint front; // 1: the ray comes from outside the solid
};

// An opened trace image; the fields are the header's.
struct SpaMap {
    SpaWords words;
    uint mapping;
    uint width;
    uint height;
    uint surfaces;
    uint flags;
    float radius;
    uint levels;
    uint code_base;
    uint code_shift;
    float w_core;
    uint nodes;
    uint cores;
    uint samples;
    uint cells;
    uint prisms;
    uint depths;
    uint images;
    float3 box_low;
    float3 box_high;
};

// The words are believed: they come from TraceMap, not from a file.
SPA_FUNCTION SpaMap spa_open(SpaWords words) {
    SpaMap map;
    map.words = words;
    map.mapping = spa_load(words, SPA_HEADER_MAPPING);
    map.width = spa_load(words, SPA_HEADER_WIDTH);
    map.height = spa_load(words, SPA_HEADER_HEIGHT);
    map.surfaces = spa_load(words, SPA_HEADER_SURFACES);
    map.flags = spa_load(words, SPA_HEADER_FLAGS);
    map.radius = spa_float(spa_load(words, SPA_HEADER_RADIUS));
    map.levels = spa_load(words, SPA_HEADER_LEVELS);
    map.code_base = spa_load(words, SPA_HEADER_CODE_BASE);
    map.code_shift = spa_load(words, SPA_HEADER_CODE_SHIFT);
    map.w_core = spa_float(spa_load(words, SPA_HEADER_W_CORE));
    map.nodes = spa_load(words, SPA_HEADER_NODES);
    map.cores = spa_load(words, SPA_HEADER_CORES);
    map.samples = spa_load(words, SPA_HEADER_SAMPLES);
    map.cells = spa_load(words, SPA_HEADER_CELLS);
    map.prisms = spa_load(words, SPA_HEADER_PRISMS);
    map.depths = spa_load(words, SPA_HEADER_DEPTHS);
    map.images = spa_load(words, SPA_HEADER_IMAGES);
    map.box_low =
        float3(spa_float(spa_load(words, SPA_HEADER_BOX)), spa_float(spa_load(words, SPA_HEADER_BOX + 1u)),
               spa_float(spa_load(words, SPA_HEADER_BOX + 2u)));
    map.box_high = float3(spa_float(spa_load(words, SPA_HEADER_BOX + 3u)),
                          spa_float(spa_load(words, SPA_HEADER_BOX + 4u)),
                          spa_float(spa_load(words, SPA_HEADER_BOX + 5u)));
    return map;
}

SPA_FUNCTION SpaHit spa_no_hit() {
    SpaHit hit;
    hit.t = 0.0f;
    hit.map = float2(0.0f, 0.0f);
    hit.normal = float3(0.0f, 0.0f, 0.0f);
    hit.layer = 0u;
    hit.side = SPA_OUTER;
    hit.front = 1u;
    return hit;
}

// The part of a ray inside the sphere of the map's radius, seen from its foot: the point nearest to the
// centre. Far origins lose their digits once, here (Haines et al. 2019).
struct SpaChord {
    float3 foot;
    float foot_t; // the foot's t; times of the chord are relative to it
    float t0;
    float t1;
    bool starts_inside_sphere; // t0 is the ray's t_min
};

// False: the ray misses the sphere, or is none.
SPA_FUNCTION bool spa_chord(SPA_IN(SpaRay) ray, float radius, SPA_OUT(SpaChord) chord) {
    float dd = dot(ray.direction, ray.direction);
    float foot_t = -dot(ray.origin, ray.direction) / dd;
    float3 foot = ray.origin + ray.direction * foot_t;
    // Once more, from nearby.
    float rest = -dot(foot, ray.direction) / dd;
    chord.foot = foot + ray.direction * rest;
    chord.foot_t = foot_t + rest;
    float inside = radius * radius - dot(chord.foot, chord.foot);
    chord.t0 = 0.0f;
    chord.t1 = 0.0f;
    chord.starts_inside_sphere = false;
    if (!(inside >= 0.0f)) return false;
    float half_chord = sqrt(inside / dd);
    float t_min = ray.t_min - chord.foot_t;
    chord.starts_inside_sphere = t_min > -half_chord;
    chord.t0 = max(-half_chord, t_min);
    chord.t1 = min(half_chord, ray.t_max - chord.foot_t);
    return chord.t0 < chord.t1;
}

SPA_END

#endif
