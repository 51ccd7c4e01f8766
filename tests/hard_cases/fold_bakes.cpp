// SPDX-License-Identifier: Apache-2.0
// Baked maps with folds: meshes with borders, of no thickness, thin, turned inside out in places.
#include "fold_maps.h"

#include "../../libspa/bake/bake.h"
#include "../../samples/samples.h"

#include <functional>
#include <random>
#include <utility>

namespace spa::test {
namespace {

OwnedPart bake(const Model& model, std::uint32_t cells, std::uint32_t layers) {
    bake::Options options;
    options.grid = options.color_grid = {Mapping::octahedral, cells + 1, cells + 1};
    options.layers = layers;
    options.threads = 1;
    bake::Result result = bake::bake_model(model, options);
    return {std::move(result.map.map.parts.front()), std::move(result.map.pixels)};
}

Vec3f middle_of(const Model& model, const Triangle& triangle) {
    Vec3f sum;
    for (const std::uint32_t v : triangle.vertex) sum = sum + model.positions[v];
    return sum * (1.0F / 3);
}

// Leaves the triangles whose middle is so.
Model with(Model model, const std::function<bool(Vec3f)>& keep) {
    std::vector<Triangle> left;
    for (const Triangle& triangle : model.triangles)
        if (keep(middle_of(model, triangle))) left.push_back(triangle);
    model.triangles = left;
    model.triangle_materials.assign(left.size(), 0);
    return model;
}

void turn(Triangle& triangle) { std::swap(triangle.vertex[0], triangle.vertex[1]); }

// The model and itself turned inside out, smaller or larger and moved.
Model with_copy(Model model, float size, Vec3f by, bool inside_out) {
    const std::size_t vertices = model.positions.size();
    const std::size_t triangles = model.triangles.size();
    for (std::size_t i = 0; i < vertices; ++i) {
        model.positions.push_back(model.positions[i] * size + by);
        model.normals.push_back(inside_out ? -model.normals[i] : model.normals[i]);
        if (!model.uvs.empty()) model.uvs.push_back(model.uvs[i]);
        if (!model.colors.empty()) model.colors.push_back(model.colors[i]);
    }
    for (std::size_t i = 0; i < triangles; ++i) {
        Triangle copy = model.triangles[i];
        for (std::uint32_t& v : copy.vertex) v += std::uint32_t(vertices);
        if (inside_out) turn(copy);
        model.triangles.push_back(copy);
    }
    model.triangle_materials.assign(model.triangles.size(), 0);
    return model;
}

} // namespace

std::vector<NamedPart> baked_fold_parts() {
    const auto sample = [](const char* name) { return samples::make_sample(name, 2); };
    std::vector<NamedPart> parts;
    parts.push_back({"folds, torus 24, 3 layers", bake(sample("torus"), 24, 3)});
    parts.push_back({"folds, cliff 24", bake(sample("cliff"), 24, 2)});
    const Model open = with(sample("torus"), [](Vec3f p) { return p.x < 0.4F || p.y < 0; });
    parts.push_back({"folds, open torus 20", bake(open, 20, 2)});
    Model turned = sample("torus");
    std::mt19937 random(3);
    for (Triangle& triangle : turned.triangles)
        if (random() % 3 == 0) turn(triangle);
    parts.push_back({"folds, turned torus 20", bake(turned, 20, 3)});
    const auto bowl = [](Vec3f p) { return p.z < 0.35F + 0.2F * p.x; };
    const Model thin = with(with_copy(sample("sphere"), 0.995F, {}, true), bowl);
    parts.push_back({"folds, thin bowl 16", bake(thin, 16, 2)});
    // A bowl with the map's centre in its opening; a ball below the north pole makes the bounds even.
    const Model ball = with_copy(sample("sphere"), 0.1F, {0.05F, 0.1F, 0.9F}, false);
    const Model half = with(ball, [](Vec3f p) {
        return p.z < 0 || (p.z > 0.79F && length(p - Vec3f{0.05F, 0.1F, 0.9F}) < 0.11F);
    });
    parts.push_back({"folds, half sphere 16", bake(half, 16, 2)});
    const Model hole = with(sample("sphere"), [](Vec3f p) { return p.z < 0.8F; });
    parts.push_back({"folds, sphere with a hole 16", bake(hole, 16, 2)});
    return parts;
}

} // namespace spa::test
