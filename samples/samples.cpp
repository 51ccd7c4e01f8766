// SPDX-License-Identifier: Apache-2.0
#include "samples.h"

#include "../libspa/core/error.h"
#include "shapes.h"

#include <algorithm>
#include <array>
#include <string>

namespace spa::samples {
namespace {

struct Entry {
    Sample sample;
    Model (*make)(int level);
};

constexpr std::array entries = {
    Entry{{"boot", "A boot, open at the top, half orange and half blue.", 3}, make_boot},
    Entry{{"sphere", "A unit sphere whose colour tells the direction.", 5}, make_sphere},
    Entry{{"torus", "A textured torus whose hole goes through the centre.", 4}, make_torus},
    Entry{{"cube", "A cube with sharp edges and one colour a face.", 0}, make_cube},
    Entry{{"spiky", "A ball with 42 needles, many of them thinner than a texel.", 2}, make_spiky},
    Entry{{"cliff", "A body with plateaus whose edges are cliffs one texel wide.", 3}, make_cliff},
    Entry{{"concave", "A bowl around a ring wall around a ball: up to five crossings a direction.", 3},
          make_concave},
    Entry{{"smooth", "A star-shaped ball with gentle bumps, smooth everywhere.", 3}, make_smooth},
};

const Entry* find_entry(std::string_view name) {
    const auto* found = std::find_if(entries.begin(), entries.end(),
                                     [&](const Entry& entry) { return entry.sample.name == name; });
    return found == entries.end() ? nullptr : found;
}

} // namespace

std::span<const Sample> list() {
    static constexpr auto samples = [] {
        std::array<Sample, entries.size()> result{};
        std::transform(entries.begin(), entries.end(), result.begin(),
                       [](const Entry& entry) { return entry.sample; });
        return result;
    }();
    return samples;
}

const Sample* find_sample(std::string_view name) {
    const Entry* entry = find_entry(name);
    return entry == nullptr ? nullptr : &entry->sample;
}

Model make_sample(std::string_view name, int level) {
    const Entry* entry = find_entry(name);
    if (entry == nullptr) {
        std::string names;
        for (const Sample& sample : list()) names += (names.empty() ? "" : ", ") + std::string(sample.name);
        throw Error(ExitCode::usage,
                    "there is no sample '" + std::string(name) + "'; the samples are " + names);
    }
    if (level < 0 || level > max_level)
        throw Error(ExitCode::usage,
                    "sample level " + std::to_string(level) + " is outside 0.." + std::to_string(max_level));
    return entry->make(level);
}

} // namespace spa::samples
