// SPDX-License-Identifier: Apache-2.0
// What the renderer's C++ and shaders tell each other, in scalar block layout. One text for C++ and GLSL.
// Addresses are of device buffers, 0: there is none.
#ifndef SPA_RENDER_DATA_H
#define SPA_RENDER_DATA_H

#if defined(__cplusplus)
#include "../../../shaders/spa_language.h"
#include <cstdint>
#define SPA_RENDER_BEGIN                                                                                     \
    namespace spa::render::data {                                                                            \
    using shader::float3;                                                                                    \
    using shader::uint;
#define SPA_RENDER_END }
#define SPA_ADDRESS std::uint64_t
#else
#define SPA_RENDER_BEGIN
#define SPA_RENDER_END
#define SPA_ADDRESS uvec2
#define float3 vec3
#endif

SPA_RENDER_BEGIN

// Instances that a ray may see.
#define SPA_MASK_STATIC 1u   // triangles that no map replaces
#define SPA_MASK_REPLACED 2u // triangles that one does
#define SPA_MASK_MAPS 4u

// One a custom index of the top-level structure. The first 16 bytes are a SpaRecord
// (shaders/spa_record.glsl), zeros for triangles.
struct RenderInstance {
    SPA_ADDRESS image;
    uint flags;
    uint part;
    uint first_triangle; // of the bottom-level structure, among all
    uint object;         // 1 + number of the map's placement; 0: no map replaces it
    float offset;        // so far above it rays leave it to see maps
    uint unused;
};

struct RenderMaterial { // base colour = color * vertex colour * texture
    float3 color;
    float alpha;
    float alpha_limit; // less alpha is no surface
    uint texture;      // SPA_NO_TEXTURE: none
    uint wrap_u;       // SPA_WRAP_...
    uint wrap_v;
    uint nearest; // 1: texels are not interpolated
};
#define SPA_NO_TEXTURE 0xFFFFFFFFu
#define SPA_WRAP_REPEAT 0u
#define SPA_WRAP_MIRRORED 1u
#define SPA_WRAP_CLAMP 2u

struct RenderTexture {
    uint first; // texel: sRGB and alpha, red lowest
    uint width;
    uint height;
};

struct RenderLight {
    uint kind; // SPA_LIGHT_...
    float3 position;
    float3 direction; // unit, the way that the light goes
    float3 intensity;
    float cos_inner;
    float cos_outer;
};
#define SPA_LIGHT_POINT 0u
#define SPA_LIGHT_DIRECTIONAL 1u
#define SPA_LIGHT_SPOT 2u

// What a ray hit; kept for each pixel between the passes. Both normals on the side that the ray came from.
struct RenderSurface {
    float3 position;
    float t;
    float3 plane; // geometric normal
    uint kind;    // as in Frame::kind
    float3 normal;
    float offset; // of the instance
    float3 albedo;
    uint object; // the same
};
#define SPA_KIND_NOTHING 0u
#define SPA_KIND_TRIANGLE 1u
#define SPA_KIND_MAP 2u // + SPA_OUTER, SPA_INNER, SPA_WALL

// Sums over the primary rays of a pixel, but depth and kind, which are the first one's.
struct RenderPixel {
    float3 direct;
    float depth;     // negative: nothing was hit
    float3 indirect; // times the number of samples
    uint kind;
    float3 normal;
    uint secondary_rays; // traced
    float3 albedo;
    uint shadow_rays;
};

struct RenderGlobals {
    SPA_ADDRESS scene; // top-level structure
    SPA_ADDRESS instances;
    SPA_ADDRESS indices;
    SPA_ADDRESS positions;
    SPA_ADDRESS normals;
    SPA_ADDRESS uvs;
    SPA_ADDRESS colors;
    SPA_ADDRESS triangle_materials;
    SPA_ADDRESS materials;
    SPA_ADDRESS textures;
    SPA_ADDRESS texels;
    SPA_ADDRESS lights;
    SPA_ADDRESS surfaces; // RenderSurface, one a pixel
    SPA_ADDRESS pixels;   // RenderPixel
    float3 eye;
    float3 right; // a ray through the point (x, y) of the image plane: x right + y up + forward
    float3 up;
    float3 forward;
    float offset; // so far above triangles rays leave them to see triangles
    uint light_count;
    uint width;
    uint height;
    uint seed;
    uint antialias;
    uint primary_mask;
    uint shadow_mask;
    uint secondary_mask;
};

// Push constants.
struct RenderBatch {
    SPA_ADDRESS globals;
    uint first_row;
    uint end_row;
    uint first_sample;
    uint end_sample;
    uint primary_ray; // number in its pixel
    uint pass;        // SPA_PASS_...
};
#define SPA_PASS_PRIMARY 0u // the samples from 0 to 1
#define SPA_PASS_SECONDARY 1u
#define SPA_GROUP_SIZE 8 // a workgroup of a compute shader is a square

SPA_RENDER_END

#endif
