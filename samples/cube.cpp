// SPDX-License-Identifier: Apache-2.0
#include "shapes.h"

namespace spa::samples {

Model make_cube(int level) {
    constexpr double half = 0.6;
    struct Face {
        Vec3d right, up;
        Vec4f color;
    };
    const Face faces[] = {
        {{0, 0, -1}, {0, 1, 0}, srgb(220, 50, 47)},  {{0, 0, 1}, {0, 1, 0}, srgb(42, 190, 200)},
        {{1, 0, 0}, {0, 0, -1}, srgb(120, 190, 30)}, {{1, 0, 0}, {0, 0, 1}, srgb(180, 60, 190)},
        {{1, 0, 0}, {0, 1, 0}, srgb(40, 90, 220)},   {{-1, 0, 0}, {0, 1, 0}, srgb(235, 185, 30)},
    };
    Model model = empty_model("faces");
    const std::uint32_t cells = 1U << level;
    for (const Face& face : faces) {
        const Vec3d normal = cross(face.right, face.up);
        const auto first = static_cast<std::uint32_t>(model.positions.size());
        for (std::uint32_t i = 0; i <= cells; ++i) {
            for (std::uint32_t j = 0; j <= cells; ++j) {
                // Exact in binary, so that faces meet in bit-equal positions.
                const double x = 2.0 * j / cells - 1, y = 1 - 2.0 * i / cells;
                add_vertex(model, (face.right * x + face.up * y + normal) * half, face.color);
                model.normals.push_back(to_float(normal));
            }
        }
        const std::uint32_t row = cells + 1;
        for (std::uint32_t i = 0; i < cells; ++i) {
            for (std::uint32_t j = 0; j < cells; ++j) {
                const std::uint32_t corner = first + i * row + j;
                add_quad(model, {corner, corner + 1, corner + row, corner + row + 1});
            }
        }
    }
    return model;
}

} // namespace spa::samples
