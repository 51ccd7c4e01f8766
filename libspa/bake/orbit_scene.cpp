// SPDX-License-Identifier: Apache-2.0
#include "orbit_scene.h"

#include <algorithm>
#include <cmath>

namespace spa::bake {
namespace {

constexpr std::uint32_t back_facing_bit = 0x80000000U;

std::array<float, 3> to_floats(Vec3d v) { return {float(v.x), float(v.y), float(v.z)}; }

GLint wrap_mode(Wrap wrap) {
    switch (wrap) {
    case Wrap::repeat: return GL_REPEAT;
    case Wrap::mirrored_repeat: return GL_MIRRORED_REPEAT;
    case Wrap::clamp_to_edge: return GL_CLAMP_TO_EDGE;
    }
    return GL_REPEAT;
}

// The first level that fits the context.
std::size_t first_level(const Texture& texture, GLint largest) {
    std::size_t level = 0;
    while (level + 1 < texture.mips.size() &&
           std::max(texture.mips[level].width, texture.mips[level].height) > std::uint32_t(largest)) {
        ++level;
    }
    return level;
}

GlObject upload(const GlFunctions& gl, const Texture& texture, std::size_t first) {
    const Image& base = texture.mips[first];
    const std::size_t levels = texture.mips.size() - first;
    GlObject object =
        make_texture(gl, GL_SRGB8_ALPHA8, GLsizei(base.width), GLsizei(base.height), GLsizei(levels));
    for (std::size_t l = 0; l < levels; ++l) {
        const Image& image = texture.mips[first + l];
        gl.TextureSubImage2D(object.name(), GLint(l), 0, 0, GLsizei(image.width), GLsizei(image.height),
                             GL_RGBA, GL_UNSIGNED_BYTE, image.pixels.data());
    }
    return object;
}

} // namespace

GpuCamera make_camera(const Grid& grid, TexelIndex texel) {
    const Vec3d g = sample_direction(grid, texel);
    const Vec3d u = normalize(g);
    // Along the poles' axis any horizontal direction will do.
    Vec3d right = normalize(Vec3d{u.z, 0, -u.x});
    if (right == Vec3d{}) right = {1, 0, 0};
    const Vec3d up = cross(u, right);
    GpuCamera camera;
    camera.ray = {g.x, g.y, g.z};
    camera.ray_length = length(g);
    camera.right = to_floats(right);
    camera.up = to_floats(up);
    camera.solid_angle = float(solid_angle(grid, texel));
    return camera;
}

std::array<Vec3d, 3> corner_positions(const CenteredModel& model, std::uint32_t triangle) {
    const Triangle& t = model.model->triangles[triangle];
    return {to_double(model.positions[t.vertex[0]]), to_double(model.positions[t.vertex[1]]),
            to_double(model.positions[t.vertex[2]])};
}

Facing facing_of(const CenteredModel& model, std::uint32_t triangle) {
    const auto [a, b, c] = corner_positions(model, triangle);
    const double volume = dot(a, cross(b, c));
    if (!std::isfinite(volume) || volume == 0) return Facing::edge_on;
    return (volume > 0) != model.mirrored ? Facing::front : Facing::back;
}

GpuCorners make_corners(const CenteredModel& model, std::uint32_t triangle, bool back_facing) {
    const Model& source = *model.model;
    GpuCorners corners;
    corners.triangle = triangle;
    corners.material = source.triangle_materials[triangle] | (back_facing ? back_facing_bit : 0);
    for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t v = source.triangles[triangle].vertex[k];
        const Vec3f p = model.positions[v];
        const Vec3f n = model.normals[v];
        std::copy_n(std::array{p.x, p.y, p.z}.begin(), 3, corners.position.begin() + std::ptrdiff_t(3 * k));
        std::copy_n(std::array{n.x, n.y, n.z}.begin(), 3, corners.normal.begin() + std::ptrdiff_t(3 * k));
        if (!source.uvs.empty()) {
            corners.uv[2 * k] = source.uvs[v].x;
            corners.uv[2 * k + 1] = source.uvs[v].y;
        }
        const Vec4f c = source.colors.empty() ? Vec4f{1, 1, 1, 1} : source.colors[v];
        std::copy_n(std::array{c.x, c.y, c.z, c.w}.begin(), 4, corners.color.begin() + std::ptrdiff_t(4 * k));
    }
    return corners;
}

MaterialTable::MaterialTable(const GlFunctions& gl, const Model& model)
    : gl_(gl), model_(&model), textures_(model.textures.size()) {
    GLint largest = 0;
    gl.GetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
    gl.PixelStorei(GL_UNPACK_ALIGNMENT, 4);
    std::vector<GpuMaterial> materials;
    for (const Material& material : model.materials) {
        GpuMaterial gpu;
        gpu.base_color = {material.base_color.x, material.base_color.y, material.base_color.z,
                          material.base_color.w};
        gpu.alpha_cutoff = material.alpha_cutoff;
        gpu.alpha_mode = material.alpha_mode == AlphaMode::mask    ? 1
                         : material.alpha_mode == AlphaMode::blend ? 2
                                                                   : 0;
        bindings_.push_back(no_index);
        if (material.texture != no_index && !model.uvs.empty()) {
            const Texture& texture = model.textures[material.texture];
            const std::size_t first = first_level(texture, largest);
            GlObject& object = textures_[material.texture];
            if (object.name() == 0) object = upload(gl, texture, first);
            gpu.texels = float(texture.mips.front().width) * float(texture.mips.front().height);
            gpu.first_level = float(first);
            bindings_.back() = find_binding(material, material.texture);
        }
        materials.push_back(gpu);
    }
    buffer_ = make_buffer(gl, std::as_bytes(std::span(materials)));
}

std::uint32_t MaterialTable::find_binding(const Material& material, std::uint32_t texture) {
    const auto same = [&](const Binding& b) {
        return b.texture == texture && b.wrap_u == material.wrap_u && b.wrap_v == material.wrap_v &&
               b.nearest == material.nearest;
    };
    const auto found = std::find_if(table_.begin(), table_.end(), same);
    if (found != table_.end()) return std::uint32_t(found - table_.begin());
    Binding binding{texture, material.wrap_u, material.wrap_v, material.nearest, make_sampler(gl_)};
    const GLuint sampler = binding.sampler.name();
    gl_.SamplerParameteri(sampler, GL_TEXTURE_WRAP_S, wrap_mode(material.wrap_u));
    gl_.SamplerParameteri(sampler, GL_TEXTURE_WRAP_T, wrap_mode(material.wrap_v));
    gl_.SamplerParameteri(sampler, GL_TEXTURE_MAG_FILTER, material.nearest ? GL_NEAREST : GL_LINEAR);
    gl_.SamplerParameteri(sampler, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    table_.push_back(std::move(binding));
    return std::uint32_t(table_.size() - 1);
}

void MaterialTable::bind(std::uint32_t binding) const {
    gl_.BindTextureUnit(0, textures_[table_[binding].texture].name());
    gl_.BindSampler(0, table_[binding].sampler.name());
}

} // namespace spa::bake
