// SPDX-License-Identifier: Apache-2.0
#include "shapes.h"

#include <cmath>
#include <numbers>
#include <random>

namespace spa::test {
namespace {

constexpr float pi = std::numbers::pi_v<float>;

std::uint32_t add_vertex(Model& model, Vec3f position, Vec3f normal) {
    model.positions.push_back(position);
    model.normals.push_back(normalize(normal));
    return std::uint32_t(model.positions.size() - 1);
}

void add_triangle(Model& model, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    model.triangles.push_back({{a, b, c}});
    model.triangle_materials.push_back(0);
}

} // namespace

Model empty_model() {
    Model model;
    model.materials.resize(1);
    return model;
}

void add_quad(Model& model, Vec3f a, Vec3f b, Vec3f c, Vec3f d) {
    const Vec3f n = cross(b - a, c - a);
    const std::uint32_t first = add_vertex(model, a, n);
    add_vertex(model, b, n);
    add_vertex(model, c, n);
    add_vertex(model, d, n);
    add_triangle(model, first, first + 1, first + 2);
    add_triangle(model, first, first + 2, first + 3);
}

void add_sphere(Model& model, Vec3f center, float radius, std::uint32_t rings, bool inside_out) {
    const std::uint32_t columns = 2 * rings;
    const auto first = std::uint32_t(model.positions.size());
    for (std::uint32_t j = 0; j <= rings; ++j) {
        for (std::uint32_t i = 0; i < columns; ++i) {
            const float theta = pi * float(j) / float(rings);
            const float phi = 2 * pi * float(i) / float(columns);
            // Exact poles, so that the columns meet in one point.
            const float s = j == 0 || j == rings ? 0.0F : std::sin(theta);
            const Vec3f u{s * std::sin(phi), std::cos(theta), s * std::cos(phi)};
            add_vertex(model, center + u * radius, inside_out ? -u : u);
        }
    }
    const auto at = [&](std::uint32_t j, std::uint32_t i) { return first + j * columns + i % columns; };
    for (std::uint32_t j = 0; j < rings; ++j) {
        for (std::uint32_t i = 0; i < columns; ++i) {
            const auto triangle = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
                if (inside_out)
                    add_triangle(model, a, c, b);
                else
                    add_triangle(model, a, b, c);
            };
            if (j + 1 < rings)
                triangle(at(j, i), at(j + 1, i), at(j + 1, i + 1));
            else
                triangle(at(j, i), at(j + 1, i), at(j, i + 1));
            if (j > 0 && j + 1 < rings) triangle(at(j, i), at(j + 1, i + 1), at(j, i + 1));
        }
    }
}

void add_box(Model& model, Vec3f l, Vec3f h) {
    add_quad(model, {l.x, l.y, h.z}, {h.x, l.y, h.z}, {h.x, h.y, h.z}, {l.x, h.y, h.z});
    add_quad(model, {h.x, l.y, l.z}, {l.x, l.y, l.z}, {l.x, h.y, l.z}, {h.x, h.y, l.z});
    add_quad(model, {h.x, l.y, h.z}, {h.x, l.y, l.z}, {h.x, h.y, l.z}, {h.x, h.y, h.z});
    add_quad(model, {l.x, l.y, l.z}, {l.x, l.y, h.z}, {l.x, h.y, h.z}, {l.x, h.y, l.z});
    add_quad(model, {l.x, h.y, h.z}, {h.x, h.y, h.z}, {h.x, h.y, l.z}, {l.x, h.y, l.z});
    add_quad(model, {l.x, l.y, l.z}, {h.x, l.y, l.z}, {h.x, l.y, h.z}, {l.x, l.y, h.z});
}

void add_torus(Model& model, float major, float minor, std::uint32_t segments) {
    const auto first = std::uint32_t(model.positions.size());
    for (std::uint32_t j = 0; j < segments; ++j) {
        for (std::uint32_t i = 0; i < segments; ++i) {
            const float phi = 2 * pi * float(j) / float(segments);
            const float psi = 2 * pi * float(i) / float(segments);
            const Vec3f out{std::sin(phi), 0, std::cos(phi)};
            const Vec3f n = out * std::cos(psi) + Vec3f{0, std::sin(psi), 0};
            add_vertex(model, out * major + n * minor, n);
        }
    }
    const auto at = [&](std::uint32_t j, std::uint32_t i) {
        return first + (j % segments) * segments + i % segments;
    };
    for (std::uint32_t j = 0; j < segments; ++j) {
        for (std::uint32_t i = 0; i < segments; ++i) {
            add_triangle(model, at(j, i), at(j + 1, i), at(j + 1, i + 1));
            add_triangle(model, at(j, i), at(j + 1, i + 1), at(j, i + 1));
        }
    }
}

Model random_soup(std::uint32_t count, std::uint32_t seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> uniform(-1, 1);
    Model model = empty_model();
    for (std::uint32_t t = 0; t < count; ++t) {
        const Vec3f at{uniform(random), uniform(random), uniform(random)};
        const float size = std::pow(10.0F, uniform(random) * 1.2F - 0.8F);
        std::uint32_t v[3];
        for (std::uint32_t& k : v) {
            const Vec3f offset = Vec3f{uniform(random), uniform(random), uniform(random)} * size;
            k = add_vertex(model, at + offset, Vec3f{uniform(random), uniform(random), uniform(random)});
        }
        add_triangle(model, v[0], v[1], v[2]);
    }
    return model;
}

void add_random_texture(Model& model, std::uint32_t size, std::uint32_t seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> uniform(-1.5F, 2.5F);
    model.uvs.clear();
    for (std::size_t v = 0; v < model.positions.size(); ++v) {
        model.uvs.push_back({uniform(random), uniform(random)});
    }
    Texture texture;
    texture.name = "random";
    Image& image = texture.mips.emplace_back();
    image.width = image.height = size;
    for (std::uint32_t i = 0; i < size * size; ++i) {
        const auto byte = [&] { return std::uint8_t(random() & 0xFFU); };
        image.pixels.push_back({byte(), byte(), byte(), 255});
    }
    build_mips(texture);
    model.materials[0].texture = std::uint32_t(model.textures.size());
    model.textures.push_back(texture);
}

} // namespace spa::test
