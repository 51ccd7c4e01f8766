// SPDX-License-Identifier: Apache-2.0
// Text in pictures, with a bitmap font of our own, so that a picture does not depend on the fonts of the
// machine that made it.
#pragma once

#include "picture.h"

#include <string_view>

namespace spa::tools {

constexpr std::uint32_t label_advance = 6; // pixels from one character to the next, at scale 1
constexpr std::uint32_t label_height = 9;  // of a line, descenders included, at scale 1

// Draws one line of text with its upper left corner at (x, y). Characters outside ASCII become '?'; what lies
// outside the picture is cut off.
void draw_label(Picture& picture, std::uint32_t x, std::uint32_t y, std::string_view text, Rgb color,
                std::uint32_t scale = 1);

} // namespace spa::tools
