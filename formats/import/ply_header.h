// SPDX-License-Identifier: Apache-2.0
// The header of a PLY file (Turk, "The PLY Polygon File Format", 1994): what the data after it looks like.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace spa::import {

enum class PlyFormat : std::uint8_t { ascii, little_endian, big_endian };
enum class PlyType : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

// Bytes of a value in the binary formats.
std::size_t size_of(PlyType type);

struct PlyProperty {
    std::string name;
    PlyType type{};       // of the value, or of the items of the list
    bool is_list = false; // a count, then so many items
    PlyType count_type{}; // lists only
};

struct PlyElement {
    std::string name;
    std::uint64_t count = 0;
    std::vector<PlyProperty> properties;
};

struct PlyHeader {
    PlyFormat format{};
    std::vector<PlyElement> elements;  // no two of the same name, in the order of the data
    std::vector<std::string> textures; // of "comment TextureFile NAME", as MeshLab writes them
    std::size_t data_offset = 0;       // of the first byte after the header
    std::size_t lines = 0;
};

// Strict: an unknown keyword or type, a word too many and an element or property declared twice are errors,
// as the data could not be told apart. One exception: a line that begins with "Created by", the comment of
// Blender 2.4, which forgot the keyword. Throws Error(invalid_data) that names the line.
PlyHeader parse_ply_header(std::string_view text, const std::filesystem::path& path);

} // namespace spa::import
