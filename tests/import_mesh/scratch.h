// SPDX-License-Identifier: Apache-2.0
// What the tests of the mesh importers share: files made on the spot, and the measures they compare.
#pragma once

#include "../../formats/import/import.h"
#include "../container/temporary_folder.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace spa::test {

// A folder for the files of one test.
class Scratch {
public:
    // Writes a file, folders included, and returns its path.
    std::filesystem::path write(const std::string& name, std::string_view content) const;
    // Writes an uncompressed 32-bit TGA, pixels (RGBA) from the upper left row by row.
    void write_tga(const std::string& name, std::uint16_t width,
                   const std::vector<std::array<std::uint8_t, 4>>& pixels) const;
    // Writes a file and imports it.
    import::Result read(const std::string& name, std::string_view content) const;
    // Writes a file, imports it and returns the message of the Error(invalid_data); "imported" if there is
    // none.
    std::string refusal(const std::string& name, std::string_view content) const;

    // The path of a file in the folder.
    [[nodiscard]] std::filesystem::path path(const std::string& name) const { return folder_.file(name); }

private:
    TemporaryFolder folder_;
};

// As Scratch::refusal, for a file that is there.
std::string refusal_of(const std::filesystem::path& path);

// The folder of the real assets; empty if it is not there.
std::filesystem::path assets();

std::array<Vec3f, 3> corners(const Model& model, std::size_t triangle);
double area(const Model& model);
// Six times the volume that closed, outward-facing triangles enclose is the sum of their determinants.
double volume(const Model& model);
bool has_warning(const import::Report& report, std::string_view part);

// The invariants that read_model promises for every result.
void expect_valid(const import::Result& result);

} // namespace spa::test
