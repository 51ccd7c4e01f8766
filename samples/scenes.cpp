// SPDX-License-Identifier: Apache-2.0
#include "scenes.h"

#include "../libspa/core/error.h"
#include "scene_makers.h"

#include <algorithm>
#include <array>
#include <string>

namespace spa::samples {
namespace {

struct Entry {
    Sample scene;
    Scene (*make)(int level);
};

constexpr std::array entries = {
    Entry{{"corner", "The boot close to the edge between two white walls, tip towards the left one.", 3},
          make_corner_a},
    Entry{{"corner-b", "The same, tip towards the edge.", 3}, make_corner_b},
    Entry{{"corner-c", "The same, leaning back into the edge: both sides light the walls.", 3},
          make_corner_c},
    Entry{{"corner-d", "The same, fallen over: most of one side is lit.", 3}, make_corner_d},
    Entry{{"wall", "The boot before a white wall, on which it casts a shadow.", 3}, make_wall},
    Entry{{"colonnade", "The boot before columns with arches, lit from above.", 3}, make_colonnade},
    Entry{{"colonnade-b", "The same, tip tilted down by 20 degrees.", 3}, make_colonnade_b},
    Entry{{"room", "A furnished room with a yard behind it: 48 objects of all kinds, seen from near and far.",
           3},
          make_room},
};

const Entry* find_entry(std::string_view name) {
    const auto* found = std::find_if(entries.begin(), entries.end(),
                                     [&](const Entry& entry) { return entry.scene.name == name; });
    return found == entries.end() ? nullptr : found;
}

} // namespace

std::span<const Sample> list_scenes() {
    static constexpr auto scenes = [] {
        std::array<Sample, entries.size()> result{};
        std::transform(entries.begin(), entries.end(), result.begin(),
                       [](const Entry& entry) { return entry.scene; });
        return result;
    }();
    return scenes;
}

const Sample* find_scene(std::string_view name) {
    const Entry* entry = find_entry(name);
    return entry == nullptr ? nullptr : &entry->scene;
}

Scene make_scene(std::string_view name, int level) {
    const Entry* entry = find_entry(name);
    if (entry == nullptr) {
        std::string names;
        for (const Sample& scene : list_scenes())
            names += (names.empty() ? "" : ", ") + std::string(scene.name);
        throw Error(ExitCode::usage,
                    "there is no scene '" + std::string(name) + "'; the scenes are " + names);
    }
    if (level < 0 || level > max_level)
        throw Error(ExitCode::usage,
                    "boot level " + std::to_string(level) + " is outside 0.." + std::to_string(max_level));
    return entry->make(level);
}

} // namespace spa::samples
