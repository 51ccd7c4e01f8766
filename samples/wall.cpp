// SPDX-License-Identifier: Apache-2.0
// The boot before the wall z = 0, seen from its side.
#include "scene_builder.h"
#include "scene_makers.h"

namespace spa::samples {

Scene make_wall(int level) {
    constexpr double half_width = 0.75, height = 0.75, depth = 0.9, thick = 0.05;
    constexpr Vec3d top{-0.05, 0.1, 0.28}; // of the plinth, its middle
    SceneBuilder scene;
    scene.add("floor", {}, make_box({-half_width, -thick, -thick}, {half_width, 0, depth}, white()));
    scene.add("wall", {}, make_box({-half_width, 0, -thick}, {half_width, height, 0}, white()));
    scene.add("plinth", {{}, {top.x, 0, top.z}}, make_box({-0.2, 0, -0.08}, {0.2, top.y, 0.08}, white()));
    scene.add_boot(level, turn_y(90), top - Vec3d{0.05, 0, 0});
    scene.add_camera("view", {0.62, 0.42, 1.35}, {0.06, 0.2, 0.1}, 30);
    scene.add_point_light("lamp", {-0.6, 0.17, 1.2}, 4);
    return scene.take();
}

} // namespace spa::samples
