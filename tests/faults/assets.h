// SPDX-License-Identifier: Apache-2.0
// Small assets as text, and the picture files that they refer to.
#pragma once

#include <string>

namespace spa::test {

// A tetrahedron as an OBJ file. shape: 0 to 999, of which each gives another map; the text is always of the
// same length. library: the name of an MTL file, whose material "paint" the faces have.
std::string obj(int shape, const std::string& library = "");

// Whatever follows makes the file longer and the model no other.
std::string obj_of_size(int shape, std::size_t bytes);

// An MTL file with the material "paint" of this picture, or of this shade of grey, 0 to 9.
std::string mtl_with_picture(const std::string& file);
std::string mtl_with_shade(int shade);

// PNG files of one pixel, both of the same size.
std::string red_png();
std::string blue_png();

} // namespace spa::test
