// SPDX-License-Identifier: Apache-2.0
// The boot between two walls. The edge is the Y axis; seen from the camera, the wall x = 0 is on the left and
// the wall z = 0 on the right.
#include "scene_builder.h"
#include "scene_makers.h"

namespace spa::samples {
namespace {

Scene make_corner(int level, const Mat3& turn, Vec3d place) {
    constexpr double width = 0.8, height = 0.6, thick = 0.05;
    SceneBuilder scene;
    scene.add("floor", {}, make_box({-thick, -thick, -thick}, {width, 0, width}, white()));
    scene.add("left wall", {}, make_box({-thick, 0, -thick}, {0, height, width}, white()));
    scene.add("right wall", {}, make_box({0, 0, -thick}, {width, height, 0}, white()));
    scene.add_boot(level, turn, place);
    scene.add_camera("view", {1.05, 0.7, 1.05}, {0.1, 0.15, 0.1}, 22);
    scene.add_point_light("lamp", {0.11, 1.7, 0.11}, 9);
    return scene.take();
}

} // namespace

// The turns: first about the boot's own axes, then about the vertical.
Scene make_corner_a(int level) { return make_corner(level, turn_y(-90), {0.225, 0, 0.085}); }
Scene make_corner_b(int level) { return make_corner(level, turn_y(-135), {0.183, 0, 0.183}); }
Scene make_corner_c(int level) { return make_corner(level, turn_y(45) * turn_x(-50), {0.225, 0, 0.225}); }
Scene make_corner_d(int level) { return make_corner(level, turn_y(-90) * turn_z(-55), {0.225, 0, 0.04}); }

} // namespace spa::samples
