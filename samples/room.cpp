// SPDX-License-Identifier: Apache-2.0
// A furnished room, open to the front, with a yard behind a wide door: many objects of all kinds, to plan
// maps for. Some are seen from close by, some from far away, some are far finer than anybody sees.
#include "scene_builder.h"
#include "scene_makers.h"
#include "shapes.h"

#include "samples.h"

#include <algorithm>
#include <array>
#include <limits>
#include <string>

namespace spa::samples {
namespace {

constexpr double width = 6, depth = 5, height = 3, thick = 0.1; // x from -width/2, z from -depth/2

Material paint(const std::string& name, float red, float green, float blue) {
    Material material;
    material.name = name;
    material.base_color = {red, green, blue, 1};
    return material;
}

int level_of(int level) { return std::clamp(level, 0, max_level); }

// With its lowest point at the height place.y.
void stand(SceneBuilder& scene, const std::string& name, const Model& mesh, double size, const Mat3& turn,
           Vec3d place) {
    Mat3 linear = turn;
    for (Vec3d& row : linear.row) row = row * size;
    double lowest = std::numeric_limits<double>::infinity();
    for (const Vec3f& p : mesh.positions) lowest = std::min(lowest, (linear * to_double(p)).y);
    scene.add(name, {linear, place - Vec3d{0, lowest, 0}}, mesh);
}

void add_walls(SceneBuilder& scene) {
    constexpr double w = width / 2, d = depth / 2;
    scene.add("floor", {}, make_box({-w, -thick, -d}, {w, 0, d}, white()));
    scene.add("ceiling", {}, make_box({-w, height, -d}, {w, height + thick, d}, white()));
    scene.add("left wall", {},
              make_box({-w - thick, 0, -d}, {-w, height, d}, paint("red", 0.63F, 0.2F, 0.15F)));
    scene.add("right wall", {},
              make_box({w, 0, -d}, {w + thick, height, d}, paint("green", 0.2F, 0.45F, 0.2F)));
    // The door is 2 wide, on the right.
    scene.add("back wall", {}, make_box({-w, 0, -d - thick}, {0.5, height, -d}, white()));
    scene.add("door post", {}, make_box({2.5, 0, -d - thick}, {w, height, -d}, white()));
    scene.add("yard", {}, make_box({-20, -2 * thick, -45}, {20, -thick, -d}, stone()));
}

void add_furniture(SceneBuilder& scene, int level) {
    scene.add("carpet", {{}, {-0.4, 0, 0.4}},
              make_box({-1.3, 0, -0.9}, {1.3, 0.01, 0.9}, paint("blue", 0.12F, 0.2F, 0.5F)));
    scene.add("picture", {{}, {-1.6, 1.7, -depth / 2}},
              make_box({-0.5, -0.35, 0}, {0.5, 0.35, 0.02}, paint("yellow", 0.75F, 0.6F, 0.12F)));
    Model table = make_box({-0.7, 0.68, -0.4}, {0.7, 0.72, 0.4}, paint("wood", 0.45F, 0.28F, 0.14F));
    for (const double x : {-0.66, 0.66})
        for (const double z : {-0.36, 0.36})
            append(table, make_box({x - 0.03, 0, z - 0.03}, {x + 0.03, 0.68, z + 0.03}, table.materials[0]));
    scene.add("table", {{}, {-1.8, 0, -1.4}}, table);

    constexpr std::array outline{
        OutlinePoint{0, 2.6, false},   OutlinePoint{0.2, 2.6, true},    OutlinePoint{0.19, 2.5, false},
        OutlinePoint{0.14, 2.4, true}, OutlinePoint{0.13, 2.0, false},  OutlinePoint{0.13, 1.4, false},
        OutlinePoint{0.14, 0.3, true}, OutlinePoint{0.17, 0.25, false}, OutlinePoint{0.17, 0.15, false},
        OutlinePoint{0.15, 0.1, true}, OutlinePoint{0.22, 0.1, true},   OutlinePoint{0.22, 0, true},
        OutlinePoint{0, 0, false}};
    const Model column = make_turned(outline, 16U << unsigned(level), stone());
    int number = 0;
    for (const double x : {-2.6, 2.6})
        for (const double z : {-2.1, 1.2})
            scene.add("column " + std::to_string(++number), {{}, {x, 0, z}}, column);
}

void add_things(SceneBuilder& scene, int level) {
    scene.add_boot(level, turn_y(-35), {-0.7, 0, 1.6});
    const Model boot = make_boot(level_of(level + 1));
    stand(scene, "left boot", boot, 1.2, turn_y(30), {-1.1, 0.01, 0.4});
    stand(scene, "fallen boot", boot, 1.2, turn_y(80) * turn_z(-70), {0.2, 0.01, 0.9});
    stand(scene, "boot on the table", make_boot(level_of(level - 1)), 1, turn_y(120), {-1.4, 0.72, -1.4});

    const Model smooth = make_smooth(level);
    stand(scene, "rock", make_smooth(level_of(level + 1)), 0.45, turn_y(20), {1.5, 0, 0.3});
    stand(scene, "stone", smooth, 0.25, turn_z(50), {0.9, 0, -0.5});
    stand(scene, "stone in the corner", smooth, 0.3, turn_x(120), {-2.5, 0, -0.4});
    stand(scene, "vase", smooth, 0.12, turn_x(-30), {-2.1, 0.72, -1.5});

    const Model torus = make_torus(level);
    stand(scene, "tyre", torus, 0.3, turn_x(90), {-0.4, 0, -1.9});
    stand(scene, "ring", torus, 0.16, turn_z(20), {-0.2, 0.01, 0.2});
    stand(scene, "bracelet", torus, 0.05, turn_x(70), {-1.7, 0.72, -1.2});

    const Model spiky = make_spiky(level_of(level - 1));
    stand(scene, "cactus", spiky, 0.25, turn_y(10), {2.3, 0, -1.2});
    stand(scene, "burr", spiky, 0.07, turn_z(33), {0.5, 0, 1.4});

    const Model bowl = make_concave(level);
    stand(scene, "fountain", bowl, 0.35, {}, {1.9, 0, 1.5});
    stand(scene, "bowl", bowl, 0.12, {}, {-1.85, 0.72, -1.35});

    const Model cliff = make_cliff(level);
    stand(scene, "crystal", cliff, 0.3, turn_z(25), {0.4, 0, -1.3});
    stand(scene, "gem", cliff, 0.06, turn_x(40), {-1.2, 0.72, -1.6});

    const Model sphere = make_sphere(level_of(level + 1));
    stand(scene, "ball", sphere, 0.22, turn_x(60), {0.9, 0, 0.9});
    stand(scene, "marble", sphere, 0.03, {}, {-0.9, 0.01, 1.2});

    const Model cube = make_cube(0);
    stand(scene, "box", cube, 0.5, turn_y(28), {2.2, 0, -0.4});
    stand(scene, "crate", cube, 0.35, turn_y(-12), {-2.3, 0, 0.6});
    stand(scene, "die", cube, 0.04, turn_y(40), {-1.5, 0.72, -1.1});
}

// Gravel at the rocks' feet, one mesh in many places; and what stands in the yard.
void add_small_and_far(SceneBuilder& scene, int level) {
    const Model pebble = make_smooth(level_of(level - 1));
    constexpr std::array<Vec3d, 8> places{Vec3d{1.0, 0, 0.2}, {1.1, 0, 0.55}, {1.3, 0, 0.8},
                                          {1.95, 0, 0.7},     {0.6, 0, 0.1},  {0.55, 0, -0.8},
                                          {-2.1, 0, -0.2},    {-2.2, 0, 0.1}};
    for (std::size_t i = 0; i < places.size(); ++i) {
        const double size = 0.012 + 0.003 * double(i % 3);
        stand(scene, "pebble " + std::to_string(i + 1), pebble, size,
              turn_y(47.0 * double(i)) * turn_x(31.0 * double(i)), places[i]);
    }
    stand(scene, "hill", make_smooth(level_of(level + 1)), 3, turn_y(70), {4, -2, -38});
    stand(scene, "far boot", make_boot(level), 8, turn_y(200), {7, -thick, -30});
    stand(scene, "far ring", make_torus(level), 1.2, turn_x(80), {3, -thick, -20});
    stand(scene, "far cactus", make_spiky(level_of(level - 1)), 1.4, {}, {2.2, -thick, -14});
}

} // namespace

Scene make_room(int level) {
    SceneBuilder scene;
    add_walls(scene);
    add_furniture(scene, level);
    add_things(scene, level);
    add_small_and_far(scene, level);
    scene.add_camera("view", {-0.1, 1.6, 4.6}, {-0.1, 0.75, -1}, 46);
    scene.add_camera("low", {0.3, 0.5, 2.4}, {-0.5, 0.25, 0}, 50);
    scene.add_point_light("lamp", {-0.6, 2.3, 0.2}, 10);
    scene.add_point_light("yard lamp", {2.5, 5, -8}, 60);
    return scene.take();
}

} // namespace spa::samples
