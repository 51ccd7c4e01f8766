// SPDX-License-Identifier: Apache-2.0
// What the orbit baker's shaders read: the structures of shaders/orbit_common.glsl and orbit.frag, filled
// from a model and a grid, and the materials' textures as OpenGL objects.
#pragma once

#include "crossings.h"
#include "gl_objects.h"

#include <array>
#include <cstdint>
#include <vector>

namespace spa::bake {

struct GpuCamera {
    std::array<double, 3> ray{};
    double ray_length = 0;
    std::array<float, 3> right{};
    std::array<float, 3> up{};
    float solid_angle = 0;
    float padding = 0;
};
static_assert(sizeof(GpuCamera) == 64);

struct GpuCorners {
    std::array<float, 9> position{};
    std::array<float, 9> normal{};
    std::array<float, 6> uv{};
    std::array<float, 12> color{};
    std::uint32_t triangle = 0;
    std::uint32_t material = 0;
};
static_assert(sizeof(GpuCorners) == 152);

struct GpuMaterial {
    std::array<float, 4> base_color{};
    float alpha_cutoff = 0;
    std::uint32_t alpha_mode = 0;
    float texels = 0;
    float first_level = 0;
};
static_assert(sizeof(GpuMaterial) == 32);

struct GpuPair {
    std::uint32_t corners = 0; // index into the batch's GpuCorners
    std::uint32_t camera = 0;
};

// A camera of the sample: exactly upright axes, so that mirror planes of a model stay exact in its view.
GpuCamera make_camera(const Grid& grid, TexelIndex texel);

enum class Facing : std::uint8_t { edge_on, front, back };

// Which side of a triangle the views that meet it see: the same for all of them. edge_on: its plane holds the
// origin, or a corner is not finite; no view sees it.
Facing facing_of(const CenteredModel& model, std::uint32_t triangle);

std::array<Vec3d, 3> corner_positions(const CenteredModel& model, std::uint32_t triangle);

GpuCorners make_corners(const CenteredModel& model, std::uint32_t triangle, bool back_facing);

// The materials of a model on the GPU. Its textures are those that materials refer to. The context and the
// model must outlive it.
class MaterialTable {
public:
    MaterialTable(const GlFunctions& gl, const Model& model);

    [[nodiscard]] const GlObject& buffer() const { return buffer_; }

    // What must be bound to shade a triangle: no_index if nothing must, else a binding for bind(). Triangles
    // of the same binding can share a draw call.
    [[nodiscard]] std::uint32_t binding_of(std::uint32_t triangle) const {
        return bindings_[model_->triangle_materials[triangle]];
    }
    void bind(std::uint32_t binding) const;

private:
    struct Binding {
        std::uint32_t texture = 0; // index into textures_
        Wrap wrap_u = Wrap::repeat, wrap_v = Wrap::repeat;
        bool nearest = false;
        GlObject sampler;
    };

    std::uint32_t find_binding(const Material& material, std::uint32_t texture);

    const GlFunctions& gl_;
    const Model* model_;
    GlObject buffer_;
    std::vector<GlObject> textures_; // as Model::textures; unused ones stay empty
    std::vector<Binding> table_;
    std::vector<std::uint32_t> bindings_; // one a material
};

} // namespace spa::bake
