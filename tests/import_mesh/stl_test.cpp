// SPDX-License-Identifier: Apache-2.0
#include "scratch.h"

#include <algorithm>
#include <cctype>
#include <cstring>

#include <gtest/gtest.h>

namespace spa::test {
namespace {

using Facet = std::array<Vec3f, 3>;

// A tetrahedron of volume 1/6, faces outwards.
const std::vector<Facet> tetrahedron{{{{0, 0, 0}, {0, 1, 0}, {1, 0, 0}}},
                                     {{{0, 0, 0}, {1, 0, 0}, {0, 0, 1}}},
                                     {{{0, 0, 0}, {0, 0, 1}, {0, 1, 0}}},
                                     {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}};

std::string binary(const std::string& title, const std::vector<Facet>& facets) {
    std::string bytes = title;
    bytes.resize(80, ' ');
    const auto put = [&](const void* data, std::size_t size) {
        bytes.append(static_cast<const char*>(data), size);
    };
    const auto count = std::uint32_t(facets.size());
    put(&count, 4);
    for (const Facet& facet : facets) {
        const Vec3f wrong_normal{0, 0, -7};
        put(&wrong_normal, 12);
        put(facet.data(), 36);
        bytes.append(2, '\0');
    }
    return bytes;
}

std::string ascii(const std::string& name, const std::vector<Facet>& facets) {
    std::string text = "solid " + name + "\n";
    for (const Facet& facet : facets) {
        text += "facet normal 0 0 0\n outer loop\n";
        for (const Vec3f& p : facet)
            text += "  vertex " + std::to_string(p.x) + " " + std::to_string(p.y) + " " +
                    std::to_string(p.z) + "\n";
        text += " endloop\nendfacet\n";
    }
    return text + "endsolid " + name + "\n";
}

void expect_tetrahedron(const import::Result& result, double times = 1) {
    expect_valid(result);
    EXPECT_EQ(result.report.format, "STL");
    EXPECT_TRUE(result.report.computed_normals);
    EXPECT_EQ(double(result.model.triangles.size()), 4 * times);
    EXPECT_NEAR(volume(result.model), times / 6, 1e-6);
    // Sharp edges: each face has the normal of its plane, not the one in the file.
    for (std::size_t t = 0; t < result.model.triangles.size(); ++t) {
        const auto [a, b, c] = corners(result.model, t);
        const Vec3f normal = normalize(cross(b - a, c - a));
        EXPECT_GT(dot(normal, result.model.normals[result.model.triangles[t].vertex[0]]), 0.99999F);
    }
}

TEST(Stl, Binary) { expect_tetrahedron(Scratch().read("t.stl", binary("made by hand", tetrahedron))); }

TEST(Stl, BinaryThatBeginsWithSolid) {
    expect_tetrahedron(Scratch().read("t.stl", binary("solid made by hand", tetrahedron)));
}

TEST(Stl, Ascii) {
    expect_tetrahedron(Scratch().read("t.stl", ascii("", tetrahedron)));
    expect_tetrahedron(Scratch().read("t.stl", ascii("name with facet and blanks", tetrahedron)));
}

TEST(Stl, AsciiInCapitalsWithSeveralSolids) {
    std::string text = ascii("a", tetrahedron) + "\n" + ascii("b", tetrahedron);
    std::transform(text.begin(), text.end(), text.begin(), [](char c) { return char(std::toupper(c)); });
    expect_tetrahedron(Scratch().read("t.stl", text), 2);
}

TEST(Stl, SharedCornersBecomeOneVertex) {
    // Two triangles of one plane: four vertices.
    const auto result = Scratch().read(
        "t.stl", binary("", {{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}}, {{{0, 0, 0}, {1, 1, 0}, {0, 1, 0}}}}));
    EXPECT_EQ(result.model.positions.size(), 4U);
}

TEST(Stl, DamageIsNamed) {
    const Scratch scratch;
    const std::string good = binary("made by hand", tetrahedron);
    const std::string short_one = scratch.refusal("t.stl", good.substr(0, good.size() - 1));
    EXPECT_NE(short_one.find("declares 4 triangles, which take 284 bytes, but the file has 283"),
              std::string::npos)
        << short_one;
    EXPECT_NE(scratch.refusal("t.stl", good + "x").find("the file has 285"), std::string::npos);
    EXPECT_NE(scratch.refusal("t.stl", "short").find("shorter than the header"), std::string::npos);
    EXPECT_NE(scratch.refusal("t.stl", binary("", {})).find("nothing to bake"), std::string::npos);

    struct Row {
        const char* text;
        const char* message;
    };
    const Row rows[] = {{"solid\nfacet normal 0 0 0\nouter loop\nvertex 0 0\nvertex",
                         "line 5: expected a number, found 'vertex'"},
                        {"solid\nfacet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nendloop\n",
                         "line 6: a facet needs three vertices, here are 2"},
                        {"solid\nfacet normal 0 0 0\nloop\n", "line 3: expected 'outer', found 'loop'"},
                        {"solid\nfacet normal 0 0 0\n", "expected 'outer', but the file ends"},
                        {"solid\nbogus\n", "line 2: expected 'facet' or 'endsolid', found 'bogus'"},
                        {"solid\nendsolid\nbogus\n", "line 3: expected 'solid', found 'bogus'"}};
    for (const Row& row : rows) {
        const std::string message = scratch.refusal("t.stl", row.text);
        EXPECT_NE(message.find(row.message), std::string::npos) << message;
    }
}

} // namespace
} // namespace spa::test
