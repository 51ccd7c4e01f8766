// SPDX-License-Identifier: Apache-2.0
// The images of a map as files that any picture program reads.
#pragma once

#include "../libspa/core/spherical_map.h"

#include <cstddef>
#include <string>
#include <vector>

namespace spa::tools {

struct ImageFile {
    std::string extension; // "png" or "exr"
    std::vector<std::byte> bytes;
};

// 8-bit RGBA PNG, sRGB, straight alpha: the stored values.
ImageFile color_file(const ImageView& color);
// The stored values: u8 and u16 as 8- and 16-bit grey PNG, f32 as EXR with one channel Y.
ImageFile depth_file(const ImageView& depth);
// rgb8: the stored values as 8-bit RGB PNG. oct8 and oct16: decoded, (n/2 + 1/2) * 65535 as 16-bit RGB PNG; 0
// where `depth` has no surface.
ImageFile normal_file(const ImageView& normal, const ImageView& depth, Mapping mapping);

} // namespace spa::tools
