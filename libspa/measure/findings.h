// SPDX-License-Identifier: Apache-2.0
// What a measurement says is wrong with a map: what no correct bake of the model would hold.
#pragma once

#include "measure_map.h"

#include <optional>
#include <string>
#include <vector>

namespace spa::measure {

struct Finding {
    const char* kind;    // "radius", "depth", "missing", "extra", "normal", "color", "alpha" or "figures"
    std::string message; // one sentence with the figures and the place
    std::optional<WorstTexel> at; // the worst or the first place; none for the radius
};

// "layer 0 outer, texel (12, 40)"; of other parts than the first "part 3 layer 0 ...".
std::string place(const WorstTexel& at);

// color_tolerance: the mean difference of colour and of alpha, in codes of 255, that is not a finding. 0
// suits colours filtered as the reference filters them (the radial baker); another texture unit rounds
// otherwise.
std::vector<Finding> find_defects(const Part& part, const Measurement& measurement, double color_tolerance);

} // namespace spa::measure
