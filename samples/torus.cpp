// SPDX-License-Identifier: Apache-2.0
#include "shapes.h"

#include "../libspa/core/element_format.h"

#include <cmath>
#include <numbers>

namespace spa::samples {
namespace {

constexpr double major_radius = 1, minor_radius = 0.4;
constexpr std::uint32_t tile = 32, tiles_around = 16, tiles_across = 8;

// A checker of full and half brightness whose hue runs once around the ring.
Image checker() {
    Image image{tile * tiles_around, tile * tiles_across, {}};
    for (std::uint32_t y = 0; y < image.height; ++y) {
        for (std::uint32_t x = 0; x < image.width; ++x) {
            const double value = (x / tile + y / tile) % 2 == 0 ? 230 : 90;
            const std::uint32_t sector = x / tile;
            const double hue = 2 * std::numbers::pi * sector / tiles_around;
            const auto channel = [&](double phase) {
                return static_cast<std::uint8_t>(
                    std::lround(value * (0.55 + 0.45 * std::cos(hue - phase * 2 * std::numbers::pi / 3))));
            };
            image.pixels.push_back({channel(0), channel(1), channel(2), 255});
        }
    }
    return image;
}

} // namespace

Model make_torus(int level) {
    const std::uint32_t around = 8U << level, across = 4U << level;
    Model model = empty_model("checker");
    // One more row and column than there are points: u and v must reach 1 where the angles are back at 0.
    for (std::uint32_t i = 0; i <= across; ++i) {
        const double psi = 2 * std::numbers::pi * (i % across) / across;
        for (std::uint32_t j = 0; j <= around; ++j) {
            const double phi = 2 * std::numbers::pi * (j % around) / around;
            const Vec3d outward{std::sin(phi), 0, std::cos(phi)};
            const Vec3d normal = outward * std::cos(psi) + Vec3d{0, -std::sin(psi), 0};
            model.positions.push_back(to_float(outward * major_radius + normal * minor_radius));
            model.normals.push_back(to_float(normal));
            model.uvs.push_back({float(j) / float(around), float(i) / float(across)});
        }
    }
    const std::uint32_t row = around + 1;
    for (std::uint32_t i = 0; i < across; ++i) {
        for (std::uint32_t j = 0; j < around; ++j) {
            const std::uint32_t corner = i * row + j;
            add_quad(model, {corner, corner + 1, corner + row, corner + row + 1});
        }
    }
    set_texture(model, "checker", checker());
    return model;
}

} // namespace spa::samples
