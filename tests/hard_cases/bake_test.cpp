// SPDX-License-Identifier: Apache-2.0
// The hard cases of meshes, by number and name: baked, compiled and traced.
#include "tracers.h"

#include "../../formats/container/reader.h"
#include "../../formats/container/writer.h"
#include "../../libspa/bake/bake.h"
#include "../../libspa/core/error.h"
#include "../../samples/samples.h"
#include "../support/shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace {

using namespace spa;
using namespace spa::test;
using trace::Hit;
using trace::Ray;

const Vec3d aside = normalize(Vec3d{0.3, -0.5, 0.81});

struct Baked {
    Subject subject;
    bake::Report report;
};

Baked bake_shape(const Model& model, std::uint32_t cells, std::uint32_t layers,
                 ElementFormat depth = ElementFormat::f32) {
    bake::Options options;
    options.grid = options.color_grid = {Mapping::octahedral, cells + 1, cells + 1};
    options.layers = layers;
    options.depth = depth;
    bake::Result result = bake::bake_model(model, options);
    return {Subject({std::move(result.map.map.parts.front()), std::move(result.map.pixels)}), result.report};
}

// From object space into the map's.
Vec3d to_map(const Part& part, Vec3d p) {
    return inverse(part.frame) * (p - part.center) * (1 / part.radius);
}

// Rays from all sides at a point near the centre; every answer is judged. Gives back how many hit.
int judged_hits(const Subject& subject, std::uint32_t count) {
    int hits = 0;
    for (const Vec3d& u : directions(count)) {
        const Ray ray = ray_through(u * 2.0, cross(u, aside) * 0.4);
        hits += subject.hit(ray).valid() ? 1 : 0;
        (void)subject.fan(ray);
        (void)subject.march(ray);
    }
    return hits;
}

TEST(HardCases, Case24_CenterOnTheSurface) {
    // Two boxes that touch in the middle of their bounds.
    Model model = empty_model();
    add_box(model, {-1, -0.5F, -0.5F}, {0, 0.5F, 0.5F});
    add_box(model, {0, -0.25F, -0.25F}, {1, 0.25F, 0.25F});
    const Baked baked = bake_shape(model, 32, 2);
    EXPECT_TRUE(baked.report.center_on_surface || baked.report.center_moved > 0);
    EXPECT_GT(judged_hits(baked.subject, 1000), 500);
}

TEST(HardCases, Case25_NeedleThinnerThanATexel) {
    Model model = empty_model();
    add_box(model, {-0.3F, -0.3F, -0.3F}, {0.3F, 0.3F, 0.3F});
    // Apart from the box, between the samples of a coarse grid.
    add_box(model, {0.8F, 0.401F, 0.231F}, {1.0F, 0.4011F, 0.2311F});
    const Baked baked = bake_shape(model, 8, 2);
    EXPECT_GE(baked.report.unseen_components, 1U);
    EXPECT_GT(judged_hits(baked.subject, 300), 0);
}

TEST(HardCases, Case26_CliffOfOneTexel) {
    const Subject cliff(star(32, cliff_radius));
    const double texel = 2.0 / 32;
    for (const Vec3d& u : directions(400)) {
        // Along -X over the low side, at the cliff, which stands where x = 0.1 of the direction.
        const Vec3d at{0.0, u.y * 0.75, u.z * 0.75};
        const double side = std::hypot(at.y, at.z);
        if (side < 0.55 || side > 0.8) continue;
        const Ray ray = ray_through(at - Vec3d{1.5, 0, 0}, at);
        const Hit hit = cliff.hit(ray);
        ASSERT_TRUE(hit.valid()) << "a leak";
        EXPECT_GT(point_at(ray, hit).x, -1.5 * texel);
        EXPECT_LT(point_at(ray, hit).x, 0.1 * 0.9 + 1.5 * texel);
    }
}

TEST(HardCases, Case27_HoleOfTheTorus) {
    const Subject open(baked_part({.sample = "torus", .cells = 64, .layers = 2}));
    const Subject filled(baked_part({.sample = "torus", .cells = 64, .layers = 1}));
    int through = 0;
    for (const Vec3d& u : directions(300)) {
        // Along the axis, through the hole, whose radius is 0.6 of 1.4.
        const Vec3d at{u.x * 0.3, 0, u.z * 0.3};
        const Ray ray = ray_through(at + Vec3d{0, 2, 0}, at);
        EXPECT_FALSE(open.hit(ray).valid());
        through += std::hypot(at.x, at.z) > 0.05 && filled.hit(ray).valid() ? 1 : 0;
    }
    EXPECT_GT(through, 200) << "one depth takes what is behind it as solid";
    const Baked one = bake_shape(samples::make_sample("torus", 2), 64, 1);
    const Baked two = bake_shape(samples::make_sample("torus", 2), 64, 2);
    EXPECT_EQ(one.report.layers.at(0).inner_coverage, 0) << "and the report has no inner ends";
    EXPECT_GT(two.report.layers.at(0).inner_coverage, 0.2);
}

TEST(HardCases, Case28_OpenAndNonManifoldMeshes) {
    Model open = empty_model();
    add_sphere(open, {0, 0, 0}, 1, 12);
    open.triangles.resize(open.triangles.size() / 2);
    open.triangle_materials.resize(open.triangles.size());
    for (const std::uint32_t layers : {1U, 2U}) {
        EXPECT_GT(judged_hits(bake_shape(open, 24, layers).subject, 500), 100);
        EXPECT_GT(judged_hits(bake_shape(random_soup(60, 5), 24, layers).subject, 500), 100);
    }
}

TEST(HardCases, Case29_DuplicateAndCoplanarFaces) {
    Model twice = empty_model();
    for (int i = 0; i < 2; ++i) add_box(twice, {-0.5F, -0.5F, -0.5F}, {0.5F, 0.5F, 0.5F});
    add_box(twice, {-0.5F, -0.5F, -0.5F}, {0.25F, 0.25F, 0.5F}); // shares planes with them
    bake::Options options;
    options.grid = options.color_grid = {Mapping::octahedral, 33, 33};
    std::vector<std::vector<std::byte>> files;
    for (const unsigned threads : {1U, 2U, 5U}) {
        options.threads = threads;
        const bake::Result result = bake::bake_model(twice, options);
        ASSERT_TRUE(container::write(result.map.map, {}, files.emplace_back()).ok());
    }
    EXPECT_EQ(files[0], files[1]);
    EXPECT_EQ(files[0], files[2]);
    EXPECT_GT(judged_hits(bake_shape(twice, 32, 2).subject, 500), 300);
}

TEST(HardCases, Case30_TrianglesThatAreNone) {
    Model model = empty_model();
    add_box(model, {-0.5F, -0.5F, -0.5F}, {0.5F, 0.5F, 0.5F});
    const Baked plain = bake_shape(model, 16, 2);
    // Of no area: dropped, or seen edge-on from everywhere.
    add_quad(model, {0.1F, 0.1F, 0.1F}, {0.1F, 0.1F, 0.1F}, {0.2F, 0.2F, 0.2F}, {0.2F, 0.2F, 0.2F});
    const Baked flat = bake_shape(model, 16, 2);
    for (const Vec3d& u : directions(200)) {
        const Ray ray = ray_through(u * 2.0, {});
        EXPECT_EQ(plain.subject.hit(ray).t, flat.subject.hit(ray).t);
    }
    for (const float bad :
         {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        Model broken = model;
        broken.positions.back().x = bad;
        try {
            EXPECT_GT(judged_hits(bake_shape(broken, 16, 2).subject, 100), 0) << "dropped";
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ExitCode::invalid_data) << error.what();
        }
    }
}

TEST(HardCases, Case31_TrianglesOverPolesAndRightAngles) {
    // Four triangles around the centre, each more than 90 degrees wide.
    Model model = empty_model();
    const Vec3f corners[4] = {{1, 1, 1}, {-1, -1, 1}, {-1, 1, -1}, {1, -1, -1}};
    for (const auto& [a, b, c] : {std::array<int, 3>{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}) {
        for (const int corner : {a, b, c}) {
            model.positions.push_back(corners[corner]);
            model.normals.push_back(normalize(corners[corner]));
        }
        const auto n = std::uint32_t(model.positions.size());
        model.triangles.push_back({{n - 3, n - 2, n - 1}});
        model.triangle_materials.push_back(0);
    }
    const Baked baked = bake_shape(model, 32, 1);
    EXPECT_EQ(baked.report.layers.at(0).outer_coverage, 1);
    for (const Vec3d& u : directions(2000)) EXPECT_TRUE(baked.subject.hit(ray_through(u * 2.0, {})).valid());
}

TEST(HardCases, Case32_SphereIsRound) {
    for (const ElementFormat depth : {ElementFormat::u8, ElementFormat::u16, ElementFormat::f32}) {
        const Baked baked = bake_shape(samples::make_sample("sphere", 5), 64, 1, depth);
        const double quantum = depth_quantum_error(depth);
        for (const Vec3d& u : directions(500)) {
            const Ray ray = ray_through(u * 2.0, {});
            const Hit hit = baked.subject.hit(ray);
            ASSERT_TRUE(hit.valid());
            // The mesh is a polyhedron, and so is the map, of cells of 1/32.
            EXPECT_NEAR(length(point_at(ray, hit)), 1, 2e-3 + 2 * quantum);
        }
    }
}

TEST(HardCases, Case33_RotatedCube) {
    Model model = empty_model();
    add_box(model, {-0.5F, -0.5F, -0.5F}, {0.5F, 0.5F, 0.5F});
    const Vec3f x = normalize(Vec3f{2, 1, -0.5F});
    const Vec3f y = normalize(cross(Vec3f{0.2F, 0.3F, 1}, x));
    const Vec3f z = cross(x, y);
    for (std::vector<Vec3f>* const vectors : {&model.positions, &model.normals})
        for (Vec3f& v : *vectors) v = x * v.x + y * v.y + z * v.z;
    const Baked baked = bake_shape(model, 64, 1);
    const Part& part = baked.subject.part();
    for (const Vec3f& face : {x, y, z, x * -1.0F, y * -1.0F, z * -1.0F}) {
        const Vec3d n = to_double(face);
        const Vec3d along = normalize(cross(n, aside));
        for (const Vec3d& u : directions(60)) {
            // A texel at this distance is less than 0.06 wide.
            const Vec3d on = n * 0.5 + along * (u.x * 0.35) + cross(n, along) * (u.y * 0.35);
            const Ray ray = ray_through(to_map(part, on + n), to_map(part, on));
            const Hit hit = baked.subject.hit(ray);
            ASSERT_TRUE(hit.valid());
            EXPECT_NEAR(hit.t, 1, 1e-5) << "faces are exact";
            EXPECT_GT(dot(to_double(hit.normal), n), 0.9999);
        }
    }
}

TEST(HardCases, Case37_TruncatedAndLyingFiles) {
    OwnedPart owned = random_part({.cells = 6, .layers = 2, .depth = ElementFormat::u16, .seed = 4});
    // Files have colours.
    const Grid grid{Mapping::octahedral, 3, 3};
    for (Layer& layer : owned.part.layers) {
        owned.pixels.push_back(std::make_unique<std::byte[]>(9 * 4));
        layer.outer.color = {
            {owned.pixels.back().get(), 9 * 4}, grid.width, grid.height, ElementFormat::rgba8};
    }
    SphericalMap map;
    map.parts.push_back(owned.part);
    std::vector<std::byte> bytes;
    ASSERT_TRUE(container::write(map, {.compression = container::Compression::none}, bytes).ok());
    container::File file;
    ASSERT_TRUE(container::open(std::span<const std::byte>(bytes), file).ok());
    const Subject from_file({file.map().parts.front(), {}});
    EXPECT_GT(judged_hits(from_file, 300), 0);
    for (std::size_t n = 0; n < bytes.size(); n += 97) {
        container::File cut;
        EXPECT_FALSE(container::open(std::span<const std::byte>(bytes).first(n), cut).ok());
    }
    std::mt19937 random(3);
    for (int i = 0; i < 300; ++i) {
        std::vector<std::byte> lying = bytes;
        lying[random() % lying.size()] ^= std::byte(1U << (random() % 8));
        container::File changed;
        EXPECT_FALSE(container::open(std::span<const std::byte>(lying), changed).ok());
    }
}

} // namespace
