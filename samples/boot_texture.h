// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "../libspa/mesh/model.h"

namespace spa::samples {

// 256 x 256: the left half orange, the right half blue, both with the faint weave of a cloth.
Image boot_texture();

} // namespace spa::samples
