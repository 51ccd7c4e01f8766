// SPDX-License-Identifier: Apache-2.0
// Why an object is planned as it is, as one sentence for people.
#pragma once

#include "scene_plan.h"

#include <cstddef>
#include <string>
#include <vector>

namespace spa::plan {

struct SizeFigures {
    std::uint32_t size = 0;
    std::uint64_t bytes = 0;
    double image_error = 0;
};

struct Reasons {
    const ObjectPlan& object; // all but `why`
    bool mappable = false;
    std::size_t places = 1; // objects that the map would serve
    double drop_below = 0;
    double without = 0; // image error without the object
    std::uint32_t largest_size = 0;
    std::vector<SizeFigures> sizes{}; // of the maps that were thought of; of the whole group
};

std::string why(const Reasons& reasons);

} // namespace spa::plan
