// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "../libspa/mesh/model.h"

#include <cstddef>
#include <string>
#include <vector>

namespace spa::samples {

// The image as a PNG file: RGB if all of it is opaque, else RGBA. Same image, same bytes. name: for messages.
// Throws Error(internal) if it cannot be encoded.
std::vector<std::byte> encode_png(const Image& image, const std::string& name);

} // namespace spa::samples
