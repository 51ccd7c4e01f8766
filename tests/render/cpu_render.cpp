// SPDX-License-Identifier: Apache-2.0
#include "cpu_render.h"

#include "../../libspa/trace/triangle_scene.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace spa::test {
namespace {

struct Color {
    Vec3d rgb;
    double alpha = 1;
};

double linear(std::uint8_t code) {
    const double s = code / 255.0;
    return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
}

std::int64_t wrap(std::int64_t i, std::int64_t size, Wrap mode) {
    if (mode == Wrap::clamp_to_edge) return std::clamp<std::int64_t>(i, 0, size - 1);
    const std::int64_t period = mode == Wrap::repeat ? size : 2 * size;
    const std::int64_t m = ((i % period) + period) % period;
    return m < size ? m : 2 * size - 1 - m;
}

Color texel(const Image& image, const Material& material, double x, double y) {
    const auto column = std::size_t(wrap(std::int64_t(x), image.width, material.wrap_u));
    const auto row = std::size_t(wrap(std::int64_t(y), image.height, material.wrap_v));
    const auto& p = image.pixels[row * image.width + column];
    return {{linear(p[0]), linear(p[1]), linear(p[2])}, p[3] / 255.0};
}

Color texture(const Image& image, const Material& material, double u, double v) {
    const double x = u * image.width;
    const double y = v * image.height;
    if (material.nearest) return texel(image, material, std::floor(x), std::floor(y));
    Color sum{{}, 0};
    for (int dy = 0; dy < 2; ++dy) {
        for (int dx = 0; dx < 2; ++dx) {
            const double column = std::floor(x - 0.5) + dx;
            const double row = std::floor(y - 0.5) + dy;
            const double weight = (1 - std::abs(x - 0.5 - column)) * (1 - std::abs(y - 0.5 - row));
            const Color color = texel(image, material, column, row);
            sum.rgb = sum.rgb + color.rgb * weight;
            sum.alpha += color.alpha * weight;
        }
    }
    return sum;
}

class CpuRenderer {
public:
    explicit CpuRenderer(const Scene& scene)
        : scene_(scene), triangles_(scene.model.positions, scene.model.triangles) {}

    CpuPixel pixel(Vec3d eye, Vec3d direction) {
        CpuPixel result;
        const auto hit = closest(eye, direction, std::numeric_limits<float>::infinity());
        if (hit.triangle == no_index) return result;
        result.hit = true;
        const Vec3d point = place(hit.triangle, hit.weights);
        result.depth = length(point - eye);
        const auto corner = [&](unsigned k) { return position(hit.triangle, k); };
        Vec3d plane = normalize(cross(corner(1) - corner(0), corner(2) - corner(0)));
        if (dot(plane, direction) > 0) plane = -plane;
        result.normal = normal(hit.triangle, hit.weights, plane);
        result.albedo = color(hit.triangle, hit.weights).rgb;
        for (const Light& light : scene_.lights)
            result.direct = result.direct + arriving(light, point, plane, result.normal);
        result.direct = {result.direct.x * result.albedo.x / std::numbers::pi,
                         result.direct.y * result.albedo.y / std::numbers::pi,
                         result.direct.z * result.albedo.z / std::numbers::pi};
        return result;
    }

private:
    struct Found {
        std::uint32_t triangle = no_index;
        Vec3d weights;
    };

    [[nodiscard]] Vec3d position(std::uint32_t triangle, unsigned corner) const {
        return to_double(scene_.model.positions[scene_.model.triangles[triangle].vertex[corner]]);
    }
    [[nodiscard]] Vec3d place(std::uint32_t triangle, Vec3d w) const {
        return position(triangle, 0) * w.x + position(triangle, 1) * w.y + position(triangle, 2) * w.z;
    }
    // Where the line meets the triangle's plane.
    [[nodiscard]] Vec3d weights(std::uint32_t triangle, Vec3d origin, Vec3d direction) const {
        const Vec3d a = position(triangle, 0);
        const Vec3d ab = position(triangle, 1) - a;
        const Vec3d ac = position(triangle, 2) - a;
        const Vec3d p = cross(direction, ac);
        const double determinant = dot(ab, p);
        const Vec3d from = origin - a;
        const double v = dot(from, p) / determinant;
        const double w = dot(direction, cross(from, ab)) / determinant;
        return {1 - v - w, v, w};
    }
    [[nodiscard]] Color color(std::uint32_t triangle, Vec3d w) const {
        const Model& model = scene_.model;
        const Material& material = model.materials[model.triangle_materials[triangle]];
        const auto& vertex = model.triangles[triangle].vertex;
        Color result{{material.base_color.x, material.base_color.y, material.base_color.z},
                     material.base_color.w};
        const auto multiply = [&](const Color& by) {
            result.rgb = {result.rgb.x * by.rgb.x, result.rgb.y * by.rgb.y, result.rgb.z * by.rgb.z};
            result.alpha *= by.alpha;
        };
        Color of_vertices{{}, 0};
        double u = 0;
        double v = 0;
        const double weight[3] = {w.x, w.y, w.z};
        for (unsigned k = 0; k < 3; ++k) {
            const Vec4f c = model.colors[vertex[k]];
            of_vertices.rgb = of_vertices.rgb + Vec3d{c.x, c.y, c.z} * weight[k];
            of_vertices.alpha += c.w * weight[k];
            u += model.uvs[vertex[k]].x * weight[k];
            v += model.uvs[vertex[k]].y * weight[k];
        }
        multiply(of_vertices);
        if (material.texture != no_index)
            multiply(texture(model.textures[material.texture].mips.front(), material, u, v));
        return result;
    }
    [[nodiscard]] bool visible(std::uint32_t triangle, Vec3d w) const {
        const Material& material = scene_.model.materials[scene_.model.triangle_materials[triangle]];
        if (material.alpha_mode == AlphaMode::mask) return color(triangle, w).alpha >= material.alpha_cutoff;
        if (material.alpha_mode == AlphaMode::blend) return color(triangle, w).alpha >= 0.5;
        return true;
    }
    [[nodiscard]] Vec3d normal(std::uint32_t triangle, Vec3d w, Vec3d plane) const {
        const auto& vertex = scene_.model.triangles[triangle].vertex;
        const auto at = [&](unsigned k) { return to_double(scene_.model.normals[vertex[k]]); };
        const Vec3d n = normalize(at(0) * w.x + at(1) * w.y + at(2) * w.z);
        if (n == Vec3d{}) return plane;
        return dot(n, plane) < 0 ? -n : n;
    }
    Found closest(Vec3d origin, Vec3d direction, float max_t) {
        triangles_.all_hits(to_float(origin), to_float(direction), max_t, hits_);
        std::sort(hits_.begin(), hits_.end(), [](const auto& a, const auto& b) { return a.t < b.t; });
        for (const trace::TriangleHit& hit : hits_) {
            const Vec3d w = weights(hit.triangle, origin, direction);
            if (visible(hit.triangle, w)) return {hit.triangle, w};
        }
        return {};
    }
    // Irradiance of one light.
    Vec3d arriving(const Light& light, Vec3d point, Vec3d plane, Vec3d normal) {
        const bool directional = light.kind == LightKind::directional;
        const Vec3d way = directional ? light.direction * -100.0 : light.position - point;
        const double distance = length(way);
        const Vec3d unit = way * (1 / distance);
        double share = dot(unit, normal);
        if (!(share > 0) || dot(unit, plane) <= 0) return {};
        if (!directional) share /= distance * distance;
        if (light.kind == LightKind::spot) share *= spot_share(light, -dot(unit, light.direction));
        if (!(share > 0)) return {};
        const Vec3d start = point + plane * 1e-4;
        if (closest(start, way, 1).triangle != no_index) return {};
        return to_double(light.intensity) * share;
    }

    const Scene& scene_;
    trace::TriangleScene triangles_;
    std::vector<trace::TriangleHit> hits_;
};

} // namespace

std::vector<CpuPixel> render_on_cpu(const Scene& scene, const Camera& camera, std::uint32_t width,
                                    std::uint32_t height) {
    CpuRenderer renderer(scene);
    std::vector<CpuPixel> pixels;
    const double up = std::tan(camera.vertical_fov / 2);
    const double right = up * width / height;
    for (std::uint32_t y = 0; y < height; ++y) {
        for (std::uint32_t x = 0; x < width; ++x) {
            const Vec3d direction{right * ((x + 0.5) * 2 / width - 1), up * (1 - (y + 0.5) * 2 / height), -1};
            pixels.push_back(renderer.pixel(camera.to_world.translation,
                                            normalize(transform_vector(camera.to_world, direction))));
        }
    }
    return pixels;
}

} // namespace spa::test
