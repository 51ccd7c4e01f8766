// SPDX-License-Identifier: Apache-2.0
#include "scene_builder.h"
#include "scenes.h"

#include <limits>

namespace spa::samples {

// The atrium of the Crytek Sponza lies along X, its floor near y = 0, in centimetres; the nave between the
// columns is some 500 wide.
Scene with_boot_in_sponza(Scene sponza, int level) {
    SceneBuilder scene(std::move(sponza));
    constexpr double size = 400; // the boot, as large as a man
    const auto boot = [](double degrees) {
        Mat3 turn = turn_y(degrees);
        for (Vec3d& row : turn.row) row = row * size;
        return turn;
    };
    scene.add_boot(level, boot(-70), {0, 0, -35});
    scene.add_camera("side", {240, 170, 100}, {-20, 55, -35}, 42);
    scene.add_camera("tip", {-420, 120, 60}, {0, 60, -35}, 30);
    scene.add_point_light("lamp", {-30, 560, 20}, 1e6F);
    return scene.take();
}

} // namespace spa::samples
