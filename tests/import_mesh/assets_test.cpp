// SPDX-License-Identifier: Apache-2.0
// Every real OBJ, PLY, STL and OFF of the assets, against what the assets' list says of it, which was counted
// by a script of its own.
#include "scratch.h"

#include "../../libspa/mesh/components.h"

#include <algorithm>
#include <map>
#include <set>

#include <gtest/gtest.h>

namespace spa::test {
namespace {

struct Row {
    const char* file;
    std::size_t triangles; // polygons counted as fans, degenerate ones included
    std::size_t textures;  // picture files that its faces use
    bool closed;           // the list calls it closed: every edge has two triangles
};

const Row rows[] = {
    {"scenes/sponza_part/sponza.obj", 33662, 13, false},
    {"obj/boot/boot.obj", 39906, 0, true},
    {"obj/armadillo/armadillo.obj", 29170, 0, true},
    {"obj/bunny/bunny.obj", 6598, 0, true},
    {"obj/torus/torus.obj", 4608, 0, true},
    {"obj/scorpion/scorpion_low_resolution.obj", 12626, 0, true},
    {"obj/penguin/penguin.obj", 6720, 0, true},
    {"obj/spot/spot_triangulated.obj", 5856, 0, true},
    {"obj/spot/spot_quadrangulated.obj", 5856, 0, true},
    {"obj/spot/spot_control_mesh.obj", 372, 0, true},
    {"obj/bootie/bootie.obj", 3776, 0, true},
    {"obj/sneakers/sneakers.obj", 4044, 1, false},
    {"obj/antique_chair/antiqueChair.obj", 9904, 2, false},
    {"obj/spiral_staircase/spiralStaircase.obj", 14656, 0, false},
    {"obj/bush/bush.obj", 40292, 2, false},
    {"obj/coconut_tree/coconutTree.obj", 81006, 1, false},
    {"obj/chandelier/chandelier-lamp.obj", 133112, 0, false},
    {"obj/teapot_textured/teapot.obj", 31456, 2, true},
    {"obj/chessboard/chessboard.obj", 125810, 0, false},
    {"obj/cuckoo_clock/cuckooClock.obj", 40432, 0, false},
    {"obj/glasses/glasses.obj", 10236, 0, false},
    {"obj/mannequin_male/mannequinMale.obj", 16407, 5, false},
    {"obj/spider_plant/spider_plant.obj", 54080, 1, false},
    {"obj/birthday_cake/birthday_cake.obj", 8172, 5, false},
    {"obj/fuze/fuze.obj", 1000, 1, true},
    {"obj/quadknot/quadknot.obj", 2880, 0, true},
    {"obj/misc/negative_indices.obj", 12, 0, true},
    {"obj/misc/cube_compressed.obj", 12, 0, true},
    {"obj/misc/two_objects.obj", 16, 0, false},
    {"obj/misc/polygonfaces.obj", 3, 0, false},
    {"obj/cornell_box/cornell_box.obj", 36, 0, false},
    {"obj/misc/cube-vertexcol.obj", 12, 0, true},
    {"obj/misc/catmark_torus_creases0.obj", 64, 0, true},
    {"obj/misc/issue-295-trianguation-failure.obj", 28, 0, true},
    {"obj/concave_polygon/concave_polygon.obj", 64, 0, false},
    {"obj/misc/box_longline.obj", 944, 0, false},
    {"obj/misc/cube_with_vertexcolors.obj", 12, 0, true},
    {"obj/spider/spider.obj", 1368, 4, false},
    {"ply/bun_zipper.ply", 69451, 0, false},
    {"ply/test_pos_color.ply", 224, 0, true},
    {"ply/cube_quads.ply", 12, 0, true},
    {"ply/suzanne.ply", 968, 0, false},
    {"ply/fuze.ply", 1000, 0, true},
    {"ply/cube_blender_uv.ply", 12, 0, true},
    {"ply/plane.ply", 2, 0, false},
    {"ply/cube_binary.ply", 12, 0, true},
    {"ply/cube_binary_header_with_RN_newline.ply", 12, 0, true},
    {"ply/float-color.ply", 1, 0, false},
    {"ply/Wuson.ply", 3732, 0, false},
    {"stl/ADIS16480.STL", 7436, 0, true},
    {"stl/torus.STL", 8700, 0, true},
    {"stl/teapot.stl", 894, 0, false},
    {"stl/unit_sphere.STL", 1280, 0, true},
    {"stl/multibody.stl", 32, 0, true},
    {"stl/Spider_ascii.stl", 1368, 0, false},
    {"stl/triangle_with_two_solids.stl", 2, 0, false},
    {"off/ballA.off", 3796, 0, true},
    {"off/comments.off", 12, 0, true},
    {"off/Cube.off", 12, 0, true},
};

bool is_picture(const std::string& name) {
    const std::string extension = std::filesystem::path(name).extension().string();
    return extension == ".png" || extension == ".jpg" || extension == ".PNG" || extension == ".JPG";
}

// Edges between positions that have other than two triangles.
std::size_t open_edges(const Model& model) {
    using Point = std::array<float, 3>;
    std::map<std::pair<Point, Point>, int> uses;
    for (std::size_t t = 0; t < model.triangles.size(); ++t) {
        const auto triangle = corners(model, t);
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3f a = triangle[k];
            const Vec3f b = triangle[(k + 1) % 3];
            const Point from{a.x, a.y, a.z};
            const Point to{b.x, b.y, b.z};
            ++uses[from < to ? std::pair{from, to} : std::pair{to, from}];
        }
    }
    return std::size_t(
        std::count_if(uses.begin(), uses.end(), [](const auto& use) { return use.second != 2; }));
}

TEST(Assets, EachHasItsTrianglesTexturesAndClosedSurface) {
    if (assets().empty()) GTEST_SKIP() << "no assets: set SPA_ASSETS to their folder";
    for (const Row& row : rows) {
        SCOPED_TRACE(row.file);
        const auto result = import::read_model(assets() / row.file);
        expect_valid(result);
        const import::Report& report = result.report;
        EXPECT_EQ(result.model.triangles.size() + report.dropped_degenerate, row.triangles);
        EXPECT_EQ(report.dropped_non_finite, 0U);
        EXPECT_EQ(std::size_t(std::count_if(report.files.begin(), report.files.end(),
                                            [](const auto& file) { return is_picture(file.name); })),
                  row.textures);
        if (row.closed) {
            EXPECT_EQ(open_edges(result.model), 0U);
            const std::string name = row.file;
            const bool turned_parts = name == "obj/teapot_textured/teapot.obj" || name == "stl/multibody.stl";
            EXPECT_EQ(find_components(result.model).open_edges == 0, !turned_parts);
        }
    }
}

TEST(Assets, TheTableIsComplete) {
    if (assets().empty()) GTEST_SKIP() << "no assets: set SPA_ASSETS to their folder";
    std::set<std::string> known{"obj/misc/number_formats.obj"};
    for (const Row& row : rows) known.insert(row.file);
    const std::set<std::string> extensions{".obj", ".ply", ".stl", ".STL", ".off"};
    for (const char* folder : {"obj", "ply", "stl", "off", "scenes"}) {
        for (const auto& entry : std::filesystem::recursive_directory_iterator(assets() / folder)) {
            if (extensions.count(entry.path().extension().string()) == 0) continue;
            const std::string name = std::filesystem::relative(entry.path(), assets()).generic_string();
            EXPECT_EQ(known.count(name), 1U) << name;
        }
    }
}

// The one face of this file joins three points on a line.
TEST(Assets, NumberFormatsHoldNothingToBake) {
    if (assets().empty()) GTEST_SKIP() << "no assets: set SPA_ASSETS to their folder";
    const std::string message = refusal_of(assets() / "obj/misc/number_formats.obj");
    EXPECT_NE(message.find("(1 triangle without area, 0 not finite)"), std::string::npos) << message;
}

// Its v lines have the colours of the cube's corners.
TEST(Assets, VertexColorsArriveAtTheirPositions) {
    if (assets().empty()) GTEST_SKIP() << "no assets: set SPA_ASSETS to their folder";
    const Model model = import::read_model(assets() / "obj/misc/cube_with_vertexcolors.obj").model;
    ASSERT_EQ(model.colors.size(), model.positions.size());
    std::set<std::array<float, 6>> pairs;
    for (std::size_t v = 0; v < model.positions.size(); ++v)
        pairs.insert({model.positions[v].x, model.positions[v].y, model.positions[v].z, model.colors[v].x,
                      model.colors[v].y, model.colors[v].z});
    EXPECT_EQ(pairs.size(), 8U); // one colour a position
}

// The leaves' opacity comes from map_d, which is the picture of map_Kd itself.
TEST(Assets, BushLeavesAreCutOut) {
    if (assets().empty()) GTEST_SKIP() << "no assets: set SPA_ASSETS to their folder";
    const Model model = import::read_model(assets() / "obj/bush/bush.obj").model;
    std::size_t cut_out = 0;
    for (const Material& material : model.materials) {
        if (material.texture == no_index || material.alpha_mode != AlphaMode::blend) continue;
        const auto& pixels = model.textures[material.texture].mips[0].pixels;
        const auto clear = std::size_t(
            std::count_if(pixels.begin(), pixels.end(), [](const auto& pixel) { return pixel[3] == 0; }));
        EXPECT_GT(clear, pixels.size() / 20);
        EXPECT_LT(clear, pixels.size());
        ++cut_out;
    }
    EXPECT_EQ(cut_out, 1U);
}

} // namespace
} // namespace spa::test
