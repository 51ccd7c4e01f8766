// SPDX-License-Identifier: Apache-2.0
// A row of columns with arches in the plane z = 0, a wall behind it and the boot before it.
#include "scene_builder.h"
#include "scene_makers.h"

#include <array>
#include <string>

namespace spa::samples {
namespace {

constexpr int columns = 4;
constexpr double spacing = 0.44, column_height = 0.62;

// Round from the top of the capital to the base; square plates above and below.
Model make_column() {
    constexpr std::array outline{OutlinePoint{0, 0.58, false},      OutlinePoint{0.072, 0.58, true},
                                 OutlinePoint{0.070, 0.566, false}, OutlinePoint{0.062, 0.552, false},
                                 OutlinePoint{0.052, 0.540, true},  OutlinePoint{0.050, 0.536, false},
                                 OutlinePoint{0.047, 0.400, false}, OutlinePoint{0.049, 0.250, false},
                                 OutlinePoint{0.052, 0.080, true},  OutlinePoint{0.060, 0.074, false},
                                 OutlinePoint{0.066, 0.064, false}, OutlinePoint{0.066, 0.054, false},
                                 OutlinePoint{0.060, 0.044, true},  OutlinePoint{0.070, 0.040, true},
                                 OutlinePoint{0, 0.040, false}};
    constexpr double plate = 0.078;
    Model column = make_turned(outline, 32, stone());
    append(column, make_box({-plate, 0.58, -plate}, {plate, column_height, plate}, stone()));
    append(column, make_box({-plate, 0, -plate}, {plate, 0.04, plate}, stone()));
    return column;
}

Scene make_with_boot(int level, const Mat3& turn) {
    constexpr double half_width = 2.4, back = -0.5, front = 1.3, thick = 0.05;
    constexpr Arch arch{spacing / 2, 0.3, 0.07, spacing / 2 - 0.06};
    SceneBuilder scene;
    scene.add("floor", {}, make_box({-half_width, -thick, back - thick}, {half_width, 0, front}, white()));
    scene.add("back wall", {}, make_box({-half_width, 0, back - thick}, {half_width, 1.2, back}, white()));
    const std::uint32_t group = scene.add_group("colonnade");
    const Model column = make_column(), bridge = make_arch(arch, 24, stone());
    for (int i = 0; i < columns; ++i) {
        const double at = (i - (columns - 1) / 2.0) * spacing;
        scene.add("column " + std::to_string(i + 1), {{}, {at, 0, 0}}, column, group);
    }
    for (int i = 0; i + 1 < columns; ++i) {
        const double at = (i - (columns - 2) / 2.0) * spacing;
        scene.add("arch " + std::to_string(i + 1), {{}, {at, column_height, 0}}, bridge, group);
    }
    scene.add_boot(level, turn, {0, 0, 0.1});
    scene.add_camera("side", {0.72, 0.42, 1.2}, {-0.02, 0.3, 0.0}, 40);
    scene.add_camera("tip", {0.0, 0.34, 1.25}, {0.0, 0.25, 0.1}, 36);
    scene.add_point_light("lamp", {0.05, 1.05, 0.38}, 2.5F);
    return scene.take();
}

} // namespace

Scene make_colonnade(int level) { return make_with_boot(level, {}); }
Scene make_colonnade_b(int level) { return make_with_boot(level, turn_x(20)); }

} // namespace spa::samples
