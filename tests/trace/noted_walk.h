// SPDX-License-Identifier: Apache-2.0
// The projective trace with every word that it loads written down: the text of ../../shaders itself, compiled
// once more with a spa_load that takes notes.
#pragma once

#include "../../libspa/trace/ray.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace spa::test {

enum class Visit : std::uint32_t {
    skipped, // the ray passes the node: nothing solid there
    opened,  // the walk goes down to its children
    cell,    // of the last level: the ray is clipped against what stands there, and misses it
    hit,     // the same, and it hits
};

// A node, in the order of the walk. Places in cells from the map's middle, right and up positive.
struct NotedNode {
    Visit visit = Visit::skipped;
    double x0 = 0, y0 = 0, x1 = 0, y1 = 0;
    float w = 0;                   // where its range of solid begins; SPA_FAR: nothing is there
    double sigma0 = 0, sigma1 = 0; // the ray's way through it
};

struct NotedPlace {
    double sigma = 0, x = 0, y = 0;
    double w = 0;       // of the ray
    double surface = 0; // W under it
};

struct NotedStretch {
    std::vector<NotedPlace> places; // from sigma 0 to 1
    std::vector<NotedNode> nodes;
};

struct NotedWalk {
    std::vector<NotedStretch> stretches;
    bool hit = false;
    NotedPlace at; // of the hit, on the last stretch
};

// words: a trace image with one range a node.
NotedWalk note_walk(std::span<const std::uint32_t> words, const trace::Ray& ray);

// Words that a trace of one ray loads; one that is loaded twice counts twice.
struct NotedLoads {
    std::size_t nodes = 0, cores = 0, samples = 0, cells = 0, prisms = 0;
    bool hit = false;
};
NotedLoads note_loads(std::span<const std::uint32_t> words, const trace::Ray& ray);

} // namespace spa::test
