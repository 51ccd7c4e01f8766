// SPDX-License-Identifier: Apache-2.0
#include "shading.h"

#include <algorithm>
#include <cmath>

namespace spa::bake {
namespace {

// Texel index under a wrap mode, as OpenGL 4.5 table 8.20 defines it.
std::uint32_t wrap_texel(Wrap wrap, std::int64_t i, std::int64_t size) {
    if (i >= 0 && i < size) return std::uint32_t(i); // spares the divisions
    switch (wrap) {
    case Wrap::repeat: i = ((i % size) + size) % size; break;
    case Wrap::mirrored_repeat: {
        const std::int64_t m = ((i % (2 * size)) + 2 * size) % (2 * size);
        i = m < size ? m : 2 * size - 1 - m;
        break;
    }
    case Wrap::clamp_to_edge: i = std::clamp<std::int64_t>(i, 0, size - 1); break;
    }
    return std::uint32_t(i);
}

// uv is untrusted: NaN gives 0, huge values lose their fraction but stay in range.
double bounded(double v) { return std::isnan(v) ? 0 : std::clamp(v, -1e9, 1e9); }

Vec4f lerp(Vec4f a, Vec4f b, float t) {
    return {a.x + (b.x - a.x) * t, a.y + (b.y - a.y) * t, a.z + (b.z - a.z) * t, a.w + (b.w - a.w) * t};
}
Vec4f multiply(Vec4f a, Vec4f b) { return {a.x * b.x, a.y * b.y, a.z * b.z, a.w * b.w}; }

class LevelSampler {
public:
    LevelSampler(const Image& image, const Material& material, const std::array<float, 256>& linear)
        : image_(image), material_(material), linear_(linear) {}

    [[nodiscard]] Vec4f nearest(double u, double v) const {
        return texel(std::int64_t(std::floor(u * image_.width)), std::int64_t(std::floor(v * image_.height)));
    }
    [[nodiscard]] Vec4f bilinear(double u, double v) const {
        const double x = u * image_.width - 0.5;
        const double y = v * image_.height - 0.5;
        const double x0 = std::floor(x);
        const double y0 = std::floor(y);
        const auto i = std::int64_t(x0);
        const auto j = std::int64_t(y0);
        const auto fx = float(x - x0);
        const auto fy = float(y - y0);
        return lerp(lerp(texel(i, j), texel(i + 1, j), fx), lerp(texel(i, j + 1), texel(i + 1, j + 1), fx),
                    fy);
    }

private:
    [[nodiscard]] Vec4f texel(std::int64_t i, std::int64_t j) const {
        const std::size_t x = wrap_texel(material_.wrap_u, i, image_.width);
        const std::size_t y = wrap_texel(material_.wrap_v, j, image_.height);
        const auto& p = image_.pixels[y * image_.width + x];
        return {linear_[p[0]], linear_[p[1]], linear_[p[2]], float(p[3]) / 255.0F};
    }

    const Image& image_;
    const Material& material_;
    const std::array<float, 256>& linear_;
};

template <class T>
T interpolate(const std::vector<T>& attribute, const Triangle& triangle, Vec3d w);

template <>
Vec2f interpolate(const std::vector<Vec2f>& attribute, const Triangle& triangle, Vec3d w) {
    const Vec2f a = attribute[triangle.vertex[0]];
    const Vec2f b = attribute[triangle.vertex[1]];
    const Vec2f c = attribute[triangle.vertex[2]];
    return {float(a.x * w.x + b.x * w.y + c.x * w.z), float(a.y * w.x + b.y * w.y + c.y * w.z)};
}

template <>
Vec4f interpolate(const std::vector<Vec4f>& attribute, const Triangle& triangle, Vec3d w) {
    const Vec4f a = attribute[triangle.vertex[0]];
    const Vec4f b = attribute[triangle.vertex[1]];
    const Vec4f c = attribute[triangle.vertex[2]];
    const auto mix = [&](float p, float q, float r) { return float(p * w.x + q * w.y + r * w.z); };
    return {mix(a.x, b.x, c.x), mix(a.y, b.y, c.y), mix(a.z, b.z, c.z), mix(a.w, b.w, c.w)};
}

} // namespace

Shader::Shader(const CenteredModel& model) : centered_(&model) {
    for (unsigned i = 0; i < 256; ++i) linear_[i] = srgb_to_linear(std::uint8_t(i));
}

bool Shader::needs_alpha(std::uint32_t triangle) const {
    const Model& model = *centered_->model;
    return model.materials[model.triangle_materials[triangle]].alpha_mode != AlphaMode::opaque;
}

Vec4f Shader::sample(const Material& material, std::uint32_t triangle, Vec3d barycentric,
                     double footprint) const {
    const Model& model = *centered_->model;
    const Triangle& t = model.triangles[triangle];
    const Texture& texture = model.textures[material.texture];
    const Image& base = texture.mips.front();
    const Vec2f uv = interpolate(model.uvs, t, barycentric);
    const double u = bounded(uv.x);
    const double v = bounded(uv.y);

    const Vec3d a = to_double(centered_->positions[t.vertex[0]]);
    const Vec3d b = to_double(centered_->positions[t.vertex[1]]);
    const Vec3d c = to_double(centered_->positions[t.vertex[2]]);
    const Vec2f ua = model.uvs[t.vertex[0]];
    const Vec2f ub = model.uvs[t.vertex[1]] - ua;
    const Vec2f uc = model.uvs[t.vertex[2]] - ua;
    const double texels = std::abs(double(ub.x) * uc.y - double(ub.y) * uc.x) * base.width * base.height;
    const double area = length(cross(b - a, c - a));
    const double lod = area > 0 && texels > 0 ? 0.5 * std::log2(footprint / area * texels) : 0.0;

    if (!(lod > 0)) {
        const LevelSampler level(base, material, linear_);
        return material.nearest ? level.nearest(u, v) : level.bilinear(u, v);
    }
    const double last = double(texture.mips.size() - 1);
    const double clamped = std::min(lod, last);
    const auto lower = std::size_t(clamped);
    const std::size_t upper = std::min(lower + 1, texture.mips.size() - 1);
    return lerp(LevelSampler(texture.mips[lower], material, linear_).bilinear(u, v),
                LevelSampler(texture.mips[upper], material, linear_).bilinear(u, v),
                float(clamped - double(lower)));
}

SurfaceColor Shader::color(std::uint32_t triangle, Vec3d barycentric, double footprint) const {
    const Model& model = *centered_->model;
    const Material& material = model.materials[model.triangle_materials[triangle]];
    Vec4f rgba = material.base_color;
    if (!model.colors.empty())
        rgba = multiply(rgba, interpolate(model.colors, model.triangles[triangle], barycentric));
    if (material.texture != no_index && !model.uvs.empty()) {
        rgba = multiply(rgba, sample(material, triangle, barycentric, footprint));
    }
    SurfaceColor result;
    result.srgba = {srgb_(rgba.x), srgb_(rgba.y), srgb_(rgba.z), 255};
    if (material.alpha_mode == AlphaMode::mask) {
        result.visible = rgba.w >= material.alpha_cutoff;
    } else if (material.alpha_mode == AlphaMode::blend) {
        result.srgba[3] = std::uint8_t(std::lround(std::clamp(rgba.w, 0.0F, 1.0F) * 255));
        result.visible = result.srgba[3] != 0;
    }
    return result;
}

Vec3f Shader::normal(std::uint32_t triangle, Vec3d barycentric) const {
    const Triangle& t = centered_->model->triangles[triangle];
    const auto corner = [&](unsigned k) { return to_double(centered_->normals[t.vertex[k]]); };
    const Vec3d n =
        normalize(corner(0) * barycentric.x + corner(1) * barycentric.y + corner(2) * barycentric.z);
    if (!(n == Vec3d{})) return to_float(n);
    const Vec3d a = to_double(centered_->positions[t.vertex[0]]);
    const Vec3d plane = cross(to_double(centered_->positions[t.vertex[1]]) - a,
                              to_double(centered_->positions[t.vertex[2]]) - a);
    return to_float(normalize(centered_->mirrored ? -plane : plane));
}

} // namespace spa::bake
