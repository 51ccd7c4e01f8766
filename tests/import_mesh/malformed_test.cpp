// SPDX-License-Identifier: Apache-2.0
// Every malformed OBJ, PLY, STL and OFF of the assets: refused with a message that names the defect, or,
// where the file is in fact valid, imported with so many triangles.
#include "scratch.h"

#include <algorithm>
#include <set>

#include <gtest/gtest.h>

namespace spa::test {
namespace {

struct Row {
    const char* file;
    std::size_t triangles; // 0: refused
    const char* message;   // part of the refusal, or of a warning; "" if there is none
};

const Row rows[] = {
    {"obj/deg_faces.obj", 3, ""},
    {"obj/eof_test.obj", 1, ""},
    {"obj/invalid-face-definition.obj", 0, "line 15: a face needs at least three vertices"},
    {"obj/invalid-keywords.obj", 0, "line 2: unknown statement 'bleh'"},
    {"obj/invalid-mixed-primitives.obj", 0, "nothing to bake: all faces lack area"},
    {"obj/invalid-optional-coordinate.obj", 0, "nothing to bake: the file holds no faces"},
    {"obj/invalid-relative-vertex-index.obj", 0, "line 1: the vertex index -4 is out of range"},
    {"obj/issue-140-zero-face-idx.obj", 0, "line 16: the vertex index 0 is out of range"},
    {"obj/malformed.obj", 0, "line 28: the vertex index 0 is out of range"},
    {"obj/missing_material_file.obj", 36, "The material 'white' is in no material library"},
    {"obj/nancolor.obj", 12, "1 vertex colour not a number"},
    {"obj/obj_wireframe.obj", 0, "nothing to bake: the file holds no faces, only 12 point or line elements"},
    {"obj/regr_3429812.obj", 4, ""},
    {"obj/test-nan.obj", 34, "Dropped 2 triangles"},
    {"obj/test_wrong_attribute_mapping.obj", 1, "Faces refer to normals, but the file has none"},
    {"off/OutOfMemory.off", 0, "declares 353535235358 vertices"},
    {"off/empty.off", 0, "the file ends before the header"},
    {"ply/colors4-not-same-type.ply", 0, "nothing to bake: the file has no faces"},
    {"ply/colors4-not-tightly-packed.ply", 0, "nothing to bake: the file has no faces"},
    {"ply/extra-token-face-property.ply", 0, "line 8: unexpected 'extradata'"},
    {"ply/extra-token-vertex-element.ply", 0, "line 3: unexpected 'extradata'"},
    {"ply/float_inf_point_cloud.ply", 0, "only 16 points"},
    {"ply/format-unsupported.ply", 0, "unknown format 'binary_mixed_endian'"},
    {"ply/incomplete-face-specification.ply", 0, "'face' has no list vertex_indices"},
    {"ply/integer-literal-at-file-end.ply", 0, "no end_header line"},
    {"ply/invalid-face-type.ply", 0, "unknown type 'float16'"},
    {"ply/invalid-vertex-property.ply", 0, "unexpected 'extradata'"},
    {"ply/normals-not-same-type.ply", 0, "nothing to bake: the file has no faces"},
    {"ply/normals-unsupported-type.ply", 0, "'nx' is of an unsigned type"},
    {"ply/payload_JVN42386607.ply", 0, "line 2: the header lacks the version"},
    {"ply/ply_empty_header.ply", 0, "nothing to bake: the file has no faces"},
    {"ply/ply_points_bin.ply", 0, "only 8 points"},
    {"ply/positions-not-all.ply", 0, "the vertices have no property 'y'"},
    {"ply/test_extra_whitespace.ply", 1, ""},
    {"ply/texcoords-not-tightly-packed.ply", 0, "nothing to bake: the file has no faces"},
    {"ply/unknown-line.ply", 0, "line 6: unknown header statement 'heh'"},
    {"ply/unsupported-face-size.ply", 0, "'face' element 2 of 2: the file ends in the middle"},
    {"stl/busted.STL", 3878, ""}, // its faces are wrong as a surface, but each is a triangle
    {"stl/empty.stl", 0, "nothing to bake"},
    {"stl/stl_empty_ascii.stl", 0, "nothing to bake"},
};

TEST(Malformed, EachEndsAsItShould) {
    const std::filesystem::path folder = assets() / "malformed";
    if (assets().empty()) GTEST_SKIP() << "no assets: set SPA_ASSETS to their folder";
    for (const Row& row : rows) {
        SCOPED_TRACE(row.file);
        if (row.triangles == 0) {
            const std::string message = refusal_of(folder / row.file);
            EXPECT_NE(message.find(row.message), std::string::npos) << message;
            continue;
        }
        const auto result = import::read_model(folder / row.file);
        expect_valid(result);
        EXPECT_EQ(result.model.triangles.size(), row.triangles);
        if (row.message[0] == '\0') {
            EXPECT_TRUE(result.report.warnings.empty());
        } else {
            EXPECT_TRUE(has_warning(result.report, row.message));
        }
    }
}

TEST(Malformed, TheTableIsComplete) {
    const std::filesystem::path folder = assets() / "malformed";
    if (assets().empty()) GTEST_SKIP() << "no assets: set SPA_ASSETS to their folder";
    std::set<std::string> known;
    for (const Row& row : rows) known.insert(row.file);
    for (const char* format : {"obj", "ply", "stl", "off"}) {
        for (const auto& entry : std::filesystem::directory_iterator(folder / format)) {
            if (entry.path().extension() == ".mtl") continue;
            EXPECT_EQ(known.count(std::string(format) + "/" + entry.path().filename().string()), 1U)
                << entry.path();
        }
    }
}

} // namespace
} // namespace spa::test
