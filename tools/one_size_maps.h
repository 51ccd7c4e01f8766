// SPDX-License-Identifier: Apache-2.0
// The maps that a scene would have without a plan: all of one size.
#pragma once

#include "plan_file.h"

#include "../libspa/bake/bake.h"
#include "../libspa/mesh/scene.h"

#include <cstdint>
#include <string>
#include <vector>

namespace spa::tools {

struct OneSizeMap {
    bake::OwnedMap map;
    std::uint64_t file_bytes = 0; // that a file of it would have, without metadata
    std::vector<std::uint32_t> nodes;
};

struct OneSizeMaps {
    std::vector<OneSizeMap> maps;
    std::vector<std::string> not_baked; // a sentence for each object that cannot be a map
    double seconds = 0;
};

// Bakes every object that the plan does not drop as `spa bake --size ONE_SIZE` does; those that the plan
// leaves as triangles too, as far as they can be baked. Instances share a map. Throws bake::Cancelled after a
// signal.
OneSizeMaps bake_one_size(const Scene& scene, const Plan& plan, bool quiet);

} // namespace spa::tools
