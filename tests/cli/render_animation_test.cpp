// SPDX-License-Identifier: Apache-2.0
// `spa render` of animations: --animation, --time, --frames.
#include "schema.h"
#include "vulkan_test.h"

#include "../../formats/import/linear_picture.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace spa::test {
namespace {

using nlohmann::json;
using Arguments = std::vector<std::string>;

template <class T>
void append(std::string& bytes, const std::vector<T>& values) {
    bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
}

class RenderAnimation : public VulkanVerbTest {
protected:
    // Two octahedra; "moving" goes from x = 2 to x = 4 in two seconds and turns meanwhile.
    void SetUp() override {
        VulkanVerbTest::SetUp();
        std::string bytes;
        append<float>(bytes, {1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1});
        append<std::uint16_t>(bytes,
                              {0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5});
        append<float>(bytes, {0, 2});
        append<float>(bytes, {2, 0, 0, 4, 0, 0});
        append<float>(bytes, {0, 0, 0, 1, 0, 1, 0, 0});
        write_file(folder_.path() / "two.bin", bytes);
        const auto view = [](int from, int length) {
            return json{{"buffer", 0}, {"byteOffset", from}, {"byteLength", length}};
        };
        const auto accessor = [](int view, int type, int count, const char* shape) {
            return json{{"bufferView", view}, {"componentType", type}, {"count", count}, {"type", shape}};
        };
        const json document{
            {"asset", {{"version", "2.0"}}},
            {"buffers", {{{"uri", "two.bin"}, {"byteLength", bytes.size()}}}},
            {"bufferViews", {view(0, 72), view(72, 48), view(120, 8), view(128, 24), view(152, 32)}},
            {"accessors",
             {accessor(0, 5126, 6, "VEC3"), accessor(1, 5123, 24, "SCALAR"), accessor(2, 5126, 2, "SCALAR"),
              accessor(3, 5126, 2, "VEC3"), accessor(4, 5126, 2, "VEC4")}},
            {"meshes", {{{"primitives", {{{"attributes", {{"POSITION", 0}}}, {"indices", 1}}}}}}},
            {"nodes",
             {{{"name", "still"}, {"mesh", 0}},
              {{"name", "moving"}, {"mesh", 0}, {"translation", {2, 0, 0}}}}},
            {"scenes", {{{"nodes", {0, 1}}}}},
            {"animations",
             {{{"name", "go"},
               {"samplers", {{{"input", 2}, {"output", 3}}, {{"input", 2}, {"output", 4}}}},
               {"channels",
                {{{"sampler", 0}, {"target", {{"node", 1}, {"path", "translation"}}}},
                 {{"sampler", 1}, {"target", {{"node", 1}, {"path", "rotation"}}}}}}}}},
        };
        write_file(folder_.path() / "two.gltf", document.dump());
    }
    Outcome run(const Arguments& arguments) { return run_spa(arguments, folder_.path()); }
    Outcome render(const std::string& output, const Arguments& more) {
        Arguments arguments{"render", "two.gltf",  "-o", output,      "-q",      "--size",
                            "48x32",  "--samples", "2",  "--backend", "pipeline"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run(arguments);
    }
    json render_json(const std::string& output, Arguments more) {
        more.insert(more.end(), {"--format", "json"});
        const Outcome outcome = render(output, more);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        json report = json::parse(outcome.out, nullptr, false);
        EXPECT_EQ(schema_error(load_schema("render"), report), "") << outcome.out;
        return report;
    }
    void bake() {
        const Outcome outcome =
            run({"bake", "two.gltf", "-o", "two.spa", "--parts", "nodes", "--size", "32", "-q"});
        ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    }
    [[nodiscard]] std::string bytes(const std::string& name) const {
        return read_file(folder_.path() / name);
    }

    TemporaryFolder folder_;
};

TEST_F(RenderAnimation, ATimeIsAPose) {
    // The camera frames what it sees, so the two octahedra lie further apart in it later on.
    EXPECT_EQ(render("rest.exr", {}).exit_code, 0);
    const json report = render_json("begin.exr", {"--time", "0"});
    EXPECT_EQ(report["animation"]["name"], "go");
    EXPECT_EQ(report["animation"]["seconds"], 2);
    EXPECT_EQ(report["animation"]["time"], 0);
    EXPECT_EQ(bytes("begin.exr"), bytes("rest.exr")) << "the animation begins at rest";
    EXPECT_EQ(render("later.exr", {"--animation", "go", "--time", "1.5"}).exit_code, 0);
    EXPECT_NE(bytes("later.exr"), bytes("rest.exr"));
    EXPECT_EQ(render("index.exr", {"--animation", "0", "--time", "1.5"}).exit_code, 0);
    EXPECT_EQ(bytes("index.exr"), bytes("later.exr"));
    const Outcome after = render("after.exr", {"--time", "7"});
    EXPECT_NE(after.err.find("the animation ends after 2 s"), std::string::npos) << after.err;
}

// Rigid nodes: a part each, which the maps follow as exactly as they are.
TEST_F(RenderAnimation, PartsFollowTheirNodes) {
    bake();
    const json report = render_json("sheet.png", {"--map", "two.spa", "--frames", "3"});
    EXPECT_EQ(report["scene"]["maps"][0]["node"], nullptr);
    EXPECT_EQ(report["scene"]["replaced_triangles"], 16);
    EXPECT_EQ(report["settings"]["primary"], "maps");
    const json& frames = report["animation"]["frames"];
    ASSERT_EQ(frames.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(frames[i]["time"].get<double>(), double(i) * 2 / 3, 1e-6);
        EXPECT_LT(frames[i]["figures"]["beauty"]["relmse"].get<double>(), 0.05) << i;
        EXPECT_GT(frames[i]["figures"]["beauty"]["psnr"].get<double>(), 18) << i;
    }
    EXPECT_GT(import::read_picture(folder_.path() / "sheet.png").width, 3 * 48U);
    const std::string first = bytes("sheet.png");
    EXPECT_EQ(render("sheet.png", {"--map", "two.spa", "--frames", "3"}).exit_code, 0);
    EXPECT_EQ(bytes("sheet.png"), first);
}

// One picture with maps is one of the sheet's: NODE says what is replaced, the parts where they stand.
TEST_F(RenderAnimation, OnePictureIsOneOfTheSheet) {
    bake();
    EXPECT_EQ(render("ref.exr", {"--time", "1.5", "--reference"}).exit_code, 0);
    for (const char* map : {"two.spa", "moving=two.spa"}) {
        const json report = render_json(
            "maps.exr", {"--time", "1.5", "--map", map, "--primary", "maps", "--compare", "ref.exr"});
        EXPECT_LT(report["comparison"]["figures"]["beauty"]["relmse"].get<double>(), 0.05) << map;
    }
}

TEST_F(RenderAnimation, WhatThereIsNot) {
    bake();
    write_file(folder_.path() / "still.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    const Outcome animation = render("out.png", {"--animation", "og"});
    EXPECT_EQ(animation.exit_code, 1);
    EXPECT_NE(animation.err.find("no animation 'og' in two.gltf; did you mean 'go'?"), std::string::npos)
        << animation.err;
    const Outcome still = run({"render", "still.obj", "-o", "out.png", "--time", "1"});
    EXPECT_EQ(still.exit_code, 1);
    EXPECT_NE(still.err.find("still.obj: has no animation"), std::string::npos) << still.err;
    const Outcome twice = render("out.png", {"--map", "two.spa", "--map", "still=two.spa"});
    EXPECT_EQ(twice.exit_code, 1);
    EXPECT_NE(twice.err.find("a map without NODE takes the place of the whole scene"), std::string::npos)
        << twice.err;
}

} // namespace
} // namespace spa::test
