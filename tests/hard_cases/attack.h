// SPDX-License-Identifier: Apache-2.0
// Hard rays against the projective trace, single and stream. Of every ray the two are compared to the bit,
// and so is what occlusion says; every n-th is judged.
#pragma once

#include "maps.h"
#include "ray_classes.h"
#include "verdict.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace spa::test {

struct Tally {
    std::uint64_t rays = 0;
    std::uint64_t hits = 0;
    std::uint64_t judged = 0;
    std::array<std::uint64_t, verdict_count> verdicts{};
    std::uint64_t stream_differs = 0;    // from the single ray, in any bit
    std::uint64_t occlusion_differs = 0; // from whether there is a hit, single or stream
    double largest_dt = 0;               // where the answer agrees, in units of R
    std::vector<std::string> failures;   // the first few, to run again

    void add(const Tally& other);
    [[nodiscard]] std::uint64_t of(Verdict verdict) const { return verdicts[std::size_t(verdict)]; }
    [[nodiscard]] bool passed() const;
};

struct AttackResult {
    std::vector<std::string> parts;
    std::vector<std::array<Tally, ray_class_count>> tallies; // of each part
    [[nodiscard]] Tally total() const;
};

struct AttackOptions {
    std::uint64_t rays_per_class = 100000; // shared among the parts
    std::uint64_t judge_every = 1;
    std::uint64_t seed = 1;
    unsigned threads = 1;
};

// Deterministic, whatever the number of threads.
AttackResult attack(const std::vector<NamedPart>& parts, const AttackOptions& options);

void print(const AttackResult& result);

} // namespace spa::test
