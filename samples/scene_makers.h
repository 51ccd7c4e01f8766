// SPDX-License-Identifier: Apache-2.0
// The scenes. Internal to this folder. level: 0..max_level, of the boot.
#pragma once

#include "../libspa/mesh/scene.h"

namespace spa::samples {

Scene make_corner_a(int level);
Scene make_corner_b(int level);
Scene make_corner_c(int level);
Scene make_corner_d(int level);
Scene make_wall(int level);
Scene make_colonnade(int level);
Scene make_colonnade_b(int level);
Scene make_room(int level);

} // namespace spa::samples
