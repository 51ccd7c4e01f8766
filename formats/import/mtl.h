// SPDX-License-Identifier: Apache-2.0
// The part of a material library (.mtl) that a base colour comes from.
#pragma once

#include "import.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace spa::import {

// A map_* statement. A texture coordinate is multiplied by scale, then offset is added (-s and -o).
struct MtlMap {
    std::string file; // as written
    Vec2f scale{1, 1}, offset{0, 0};
    bool clamp = false;
    friend bool operator==(const MtlMap&, const MtlMap&) = default;
};

struct MtlMaterial {
    std::string name;
    std::size_t line = 0; // of newmtl
    std::optional<Vec3f> diffuse;
    std::optional<float> dissolve, transparency; // d and Tr
    std::optional<MtlMap> map_diffuse, map_dissolve;
};

// Reads newmtl, Kd, d, Tr, map_Kd and map_d (any case); everything else says how a surface reflects, not what
// colour it has, and is passed over. Numbers that cannot be read, and Kd as a spectrum or in XYZ, are left
// out with a warning in `report` that begins with `name`, the library's name as referenced. Stops after
// max_materials + 1 materials, which is one too many. O(size).
inline constexpr std::size_t max_materials = std::size_t{1} << 16U;
std::vector<MtlMaterial> parse_mtl(std::string_view text, const std::string& name, Report& report);

} // namespace spa::import
