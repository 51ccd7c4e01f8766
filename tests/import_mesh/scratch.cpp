// SPDX-License-Identifier: Apache-2.0
#include "scratch.h"

#include "../../libspa/core/error.h"

#include <cmath>
#include <cstdlib>
#include <fstream>

namespace spa::test {

std::filesystem::path Scratch::write(const std::string& name, std::string_view content) const {
    std::filesystem::path path = folder_.file(name);
    std::filesystem::create_directories(path.parent_path());
    // Truncating a file makes ext4 flush it when it is closed; a new one is written thousands of times
    // faster.
    std::filesystem::remove(path);
    std::ofstream file(path, std::ios::binary);
    file.write(content.data(), std::streamsize(content.size()));
    return path;
}

void Scratch::write_tga(const std::string& name, std::uint16_t width,
                        const std::vector<std::array<std::uint8_t, 4>>& pixels) const {
    const std::size_t height = pixels.size() / width;
    // Type 2 (true colour), 32 bits a pixel, descriptor: 8 alpha bits, origin upper left.
    std::string bytes{"\0\0\2\0\0\0\0\0\0\0\0\0", 12};
    for (const std::size_t value : {std::size_t{width}, height}) {
        bytes += char(value & 0xFFU);
        bytes += char(value >> 8U);
    }
    bytes += "\x20\x28";
    for (const auto& pixel : pixels)
        for (const std::size_t channel : {2U, 1U, 0U, 3U}) bytes += char(pixel[channel]);
    write(name, bytes);
}

import::Result Scratch::read(const std::string& name,
                             std::string_view content) const {return import::read_model(write(name, content));
} // namespace spa::test

std::string Scratch::refusal(const std::string& name, std::string_view content) const {
    return refusal_of(write(name, content));
}

std::string refusal_of(const std::filesystem::path& path) {
    try {
        expect_valid(import::read_model(path));
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::invalid_data) << error.what();
        std::string message = error.what();
        EXPECT_EQ(message.rfind(path.string(), 0), 0U) << "a message starts with the path: " << message;
        return message;
    }
    return "imported";
}

std::filesystem::path assets() {
    const char* const variable = std::getenv("SPA_ASSETS");
    const std::filesystem::path folder = variable != nullptr ? variable : SPA_ASSETS_DIR;
    return std::filesystem::is_directory(folder) ? folder : std::filesystem::path{};
}

std::array<Vec3f, 3> corners(const Model& model, std::size_t triangle) {
    const auto& v = model.triangles[triangle].vertex;
    return {model.positions[v[0]], model.positions[v[1]], model.positions[v[2]]};
}

double area(const Model& model) {
    double sum = 0;
    for (std::size_t t = 0; t < model.triangles.size(); ++t) {
        const auto [a, b, c] = corners(model, t);
        sum += length(cross(to_double(b) - to_double(a), to_double(c) - to_double(a))) / 2;
    }
    return sum;
}

double volume(const Model& model) {
    double sum = 0;
    for (std::size_t t = 0; t < model.triangles.size(); ++t) {
        const auto [a, b, c] = corners(model, t);
        sum += dot(to_double(a), cross(to_double(b), to_double(c))) / 6;
    }
    return sum;
}

bool has_warning(const import::Report& report, std::string_view part) {
    for (const std::string& warning : report.warnings) {
        if (warning.find(part) != std::string::npos) return true;
    }
    return false;
}

void expect_valid(const import::Result& result) {
    const Model& model = result.model;
    const std::size_t vertices = model.positions.size();
    EXPECT_FALSE(model.triangles.empty());
    EXPECT_EQ(model.normals.size(), vertices);
    EXPECT_TRUE(model.uvs.empty() || model.uvs.size() == vertices);
    EXPECT_TRUE(model.colors.empty() || model.colors.size() == vertices);
    EXPECT_EQ(model.triangle_materials.size(), model.triangles.size());
    EXPECT_FALSE(model.materials.empty());
    std::size_t wrong = 0;
    for (std::size_t v = 0; v < vertices; ++v) {
        wrong += is_finite(model.positions[v]) ? 0 : 1;
        wrong += std::abs(length(model.normals[v]) - 1) < 1e-5F ? 0 : 1;
    }
    for (std::size_t t = 0; t < model.triangles.size(); ++t) {
        for (const std::uint32_t v : model.triangles[t].vertex) wrong += v < vertices ? 0 : 1;
        wrong += model.triangle_materials[t] < model.materials.size() ? 0 : 1;
    }
    for (const Material& material : model.materials)
        wrong += material.texture == no_index || material.texture < model.textures.size() ? 0 : 1;
    EXPECT_EQ(wrong, 0U);
    EXPECT_FALSE(result.report.files.empty());
}

} // namespace spa::test
