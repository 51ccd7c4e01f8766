// SPDX-License-Identifier: Apache-2.0
// `spa render` from end to end, on software Vulkan: an octahedron over a floor, and a map of the octahedron.
#include "process.h"
#include "schema.h"
#include "vulkan_test.h"

#include "../../formats/import/linear_picture.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <optional>

namespace spa::test {
namespace {

using nlohmann::json;
using Arguments = std::vector<std::string>;

constexpr const char* ball = "o ball\n"
                             "v 1 0 0\nv -1 0 0\nv 0 1 0\nv 0 -1 0\nv 0 0 1\nv 0 0 -1\n"
                             "f 1 3 5\nf 3 2 5\nf 2 4 5\nf 4 1 5\nf 3 1 6\nf 2 3 6\nf 4 2 6\nf 1 4 6\n";
constexpr const char* floor_below = "o floor\n"
                                    "v -3 -1.2 -3\nv 3 -1.2 -3\nv 3 -1.2 3\nv -3 -1.2 3\n"
                                    "f 7 9 8\nf 7 10 9\n";

// An environment variable of this process and of those it starts, as it was before when this goes.
class Environment {
public:
    Environment(const char* name, const char* value) : name_(name) {
        if (const char* const before = std::getenv(name)) before_ = before;
        setenv(name, value, 1);
    }
    ~Environment() {
        if (before_)
            setenv(name_, before_->c_str(), 1);
        else
            unsetenv(name_);
    }
    Environment(const Environment&) = delete;
    Environment& operator=(const Environment&) = delete;

private:
    const char* name_;
    std::optional<std::string> before_;
};

class Render : public VulkanVerbTest {
protected:
    void SetUp() override {
        VulkanVerbTest::SetUp();
        write_file(path("scene.obj"), std::string(ball) + floor_below);
        write_file(path("ball.obj"), ball);
    }

    void bake() { ASSERT_EQ(run({"bake", "ball.obj", "-o", "ball.spa", "--size", "32"}).exit_code, 0); }
    Outcome run(const Arguments& arguments) { return run_spa(arguments, folder_.path()); }
    // Small and quick unless it is told otherwise. Software Vulkan compiles pipelines in a fifth of the time
    // that it takes for one shader with all in it.
    Outcome render(const std::string& output, const Arguments& more = {}) {
        Arguments arguments{"render", "scene.obj", "-o", output, "-q"};
        for (const auto& [option, value] :
             {std::pair{"--size", "48x32"}, {"--samples", "4"}, {"--backend", "pipeline"}})
            if (std::find(more.begin(), more.end(), option) == more.end())
                arguments.insert(arguments.end(), {option, value});
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run(arguments);
    }
    json render_json(const std::string& output, Arguments more = {}) {
        more.insert(more.end(), {"--format", "json"});
        const Outcome outcome = render(output, more);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        json report = json::parse(outcome.out, nullptr, false);
        EXPECT_EQ(schema_error(load_schema("render"), report), "") << outcome.out;
        return report;
    }
    [[nodiscard]] std::filesystem::path path(const std::string& name) const { return folder_.path() / name; }
    [[nodiscard]] bool exists(const std::string& name) const { return std::filesystem::exists(path(name)); }
    [[nodiscard]] std::vector<Vec3f> pixels(const std::string& name) const {
        return import::read_picture(path(name)).layers[0].pixels;
    }
    // The values of one channel of an EXR.
    [[nodiscard]] std::vector<float> channel(const std::string& name, const std::string& channel) const {
        const auto input = OIIO::ImageInput::open(path(name).string());
        if (!input) return {};
        const OIIO::ImageSpec& spec = input->spec();
        const int index = spec.channelindex(channel);
        EXPECT_GE(index, 0) << channel;
        std::vector<float> values(std::size_t(spec.width) * std::size_t(spec.height));
        EXPECT_TRUE(input->read_image(0, 0, index, index + 1, OIIO::TypeDesc::FLOAT, values.data()));
        return values;
    }
    [[nodiscard]] std::size_t count(const std::vector<float>& values, float value) const {
        return std::size_t(std::count(values.begin(), values.end(), value));
    }

    TemporaryFolder folder_;
};

TEST_F(Render, ListsDevices) {
    const Outcome outcome = run({"render", "--list-devices", "--format", "json"});
    const json report = json::parse(outcome.out);
    EXPECT_EQ(schema_error(load_schema("render-devices"), report), "");
    const Outcome text = run({"render", "--list-devices"});
    EXPECT_EQ(text.exit_code, 0);
    for (const json& device : report["devices"])
        EXPECT_NE(text.out.find(device["name"].get<std::string>()), std::string::npos);
}

TEST_F(Render, APngAndWhatTheSceneLacks) {
    const Outcome outcome = render("out.png");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_NE(outcome.err.find("spa: note: scene.obj: has no camera"), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find("spa: note: scene.obj: has no light"), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.out.find("out.png"), std::string::npos);
    EXPECT_NE(outcome.out.find("48x32"), std::string::npos) << outcome.out;
    EXPECT_EQ(folder_.names(), (std::vector<std::string>{"ball.obj", "out.png", "scene.obj"}));
    const std::vector<Vec3f> picture = pixels("out.png");
    ASSERT_EQ(picture.size(), 48U * 32);
    EXPECT_EQ(picture[0], Vec3f{}) << "the background is black";
    EXPECT_GT(picture[16 * 48 + 24].x, 0.05F) << "in the middle is the octahedron";
}

TEST_F(Render, TheReportSaysWhatWasDone) {
    bake();
    const json report =
        render_json("out.exr", {"--map", "ball=ball.spa", "--antialias", "2", "--seed", "7", "--method",
                                "fan", "--test-rays", "by-distance", "--exposure", "-1.5", "--layers", "1"});
    EXPECT_EQ(report["scene"]["triangles"], 10);
    EXPECT_EQ(report["scene"]["replaced_triangles"], 8);
    EXPECT_EQ(report["scene"]["maps"][0]["places"], 1);
    EXPECT_EQ(report["settings"]["seed"], 7);
    EXPECT_EQ(report["settings"]["test_rays"], "by-distance");
    EXPECT_EQ(report["settings"]["exposure"], -1.5);
    EXPECT_EQ(report["settings"]["layers"], 1);
    EXPECT_EQ(report["files"][0]["bytes"], std::filesystem::file_size(path("out.exr")));
    EXPECT_GT(report["memory"]["maps"], 0);
    EXPECT_GT(report["memory"]["replaced_triangles"], 0) << "primary rays meet them";
    EXPECT_EQ(report["rays"]["primary"]["count"], 2 * 48 * 32);
    EXPECT_GT(report["rays"]["secondary"]["count"], 0);
    EXPECT_TRUE(report["comparison"].is_null());
}

TEST_F(Render, AnExrHasLayersThatOthersRead) {
    ASSERT_EQ(render("out.exr").exit_code, 0);
    const auto input = OIIO::ImageInput::open(path("out.exr").string());
    ASSERT_TRUE(input) << OIIO::geterror();
    EXPECT_EQ(input->spec().width, 48);
    EXPECT_EQ(input->spec().format, OIIO::TypeDesc::FLOAT);
    const std::vector<float> red = channel("out.exr", "R"), direct = channel("out.exr", "direct.R"),
                             indirect = channel("out.exr", "indirect.R"), kind = channel("out.exr", "kind"),
                             depth = channel("out.exr", "depth.Z");
    std::size_t hits = 0;
    for (std::size_t i = 0; i < red.size(); ++i) {
        EXPECT_EQ(red[i], direct[i] + indirect[i]);
        EXPECT_EQ(kind[i] == 0, std::isinf(depth[i]));
        hits += kind[i] != 0 ? 1 : 0;
    }
    EXPECT_GT(hits, red.size() / 8);
    EXPECT_LT(hits, red.size());
    EXPECT_GT(*std::max_element(indirect.begin(), indirect.end()), 0);
    for (const char* const name : {"normal.X", "normal.Y", "normal.Z", "albedo.R", "albedo.G", "albedo.B"})
        EXPECT_EQ(channel("out.exr", name).size(), red.size());
}

TEST_F(Render, EqualSeedsGiveEqualBytes) {
    for (const char* const extension : {".exr", ".png"}) {
        const std::string first = std::string("a") + extension, second = std::string("b") + extension,
                          other = std::string("c") + extension;
        ASSERT_EQ(render(first).exit_code, 0);
        ASSERT_EQ(render(second).exit_code, 0);
        ASSERT_EQ(render(other, {"--seed", "2"}).exit_code, 0);
        EXPECT_EQ(read_file(path(first)), read_file(path(second)));
        EXPECT_NE(read_file(path(first)), read_file(path(other)));
    }
}

TEST_F(Render, AMapTakesTheNodesPlace) {
    bake();
    ASSERT_EQ(render("triangles.exr").exit_code, 0);
    ASSERT_EQ(render("maps.exr", {"--map", "ball=ball.spa", "--primary", "maps"}).exit_code, 0);
    ASSERT_EQ(render("second.exr", {"--map", "ball=ball.spa"}).exit_code, 0);
    const std::vector<float> triangles = channel("triangles.exr", "kind"), maps = channel("maps.exr", "kind"),
                             second = channel("second.exr", "kind");
    EXPECT_EQ(triangles, second) << "primary rays meet triangles unless they are told otherwise";
    EXPECT_EQ(count(triangles, 0) + count(triangles, 1), triangles.size());
    EXPECT_GT(count(maps, 2), 20U) << "outer ends of the map's intervals";
    EXPECT_GT(count(maps, 1), 50U) << "the floor stays";
    EXPECT_NEAR(double(count(maps, 0)), double(count(triangles, 0)), 30) << "the silhouette is the same";
    EXPECT_NE(read_file(path("triangles.exr")), read_file(path("second.exr")));
}

TEST_F(Render, EveryMethodAndBackend) {
    bake();
    ASSERT_EQ(render("ref.exr").exit_code, 0);
    for (const Arguments& method : std::vector<Arguments>{{"projective"},
                                                          {"fan", "--test-rays", "3"},
                                                          {"march", "--test-rays", "64"},
                                                          {"sphere"},
                                                          {"projective", "--backend", "query"},
                                                          {"fan", "--backend", "query"}}) {
        Arguments more{"--map", "ball=ball.spa", "--primary", "maps", "--compare", "ref.exr", "--method"};
        more.insert(more.end(), method.begin(), method.end());
        const json error = render_json("out.exr", more)["comparison"]["figures"]["beauty"]["relmse"];
        EXPECT_GT(error, 0) << method.front();
        EXPECT_LT(error, method.front() == "sphere" ? 1 : 0.1) << method.front();
    }
}

TEST_F(Render, TheReferenceIsOfTrianglesAlone) {
    bake();
    const json report = render_json("ref.exr", {"--reference", "--map", "ball=ball.spa"});
    EXPECT_EQ(report["settings"]["secondary"], "triangles");
    EXPECT_EQ(report["settings"]["samples"], 4) << "as given";
    EXPECT_TRUE(report["scene"]["maps"].empty());
    ASSERT_EQ(render("plain.exr").exit_code, 0);
    EXPECT_EQ(read_file(path("ref.exr")), read_file(path("plain.exr")));
}

TEST_F(Render, ComparesWithAReference) {
    bake();
    ASSERT_EQ(render("ref.exr", {"--reference", "--samples", "64"}).exit_code, 0);
    const json same = render_json("same.exr", {"--samples", "64", "--compare", "ref.exr", "--fail",
                                               "relmse=0,indirect.relmse=0,ssim=1", "--difference", "d.png"});
    EXPECT_EQ(same["comparison"]["figures"]["indirect"]["relmse"], 0);
    EXPECT_TRUE(same["comparison"]["figures"]["beauty"]["psnr"].is_null());
    EXPECT_TRUE(exists("d.png"));

    const Outcome fails = render("noisy.png", {"--map", "ball=ball.spa", "--compare", "ref.exr", "--fail",
                                               "direct.relmse=10,indirect.relmse=1e-9", "--format", "json"});
    EXPECT_EQ(fails.exit_code, 6);
    EXPECT_NE(fails.err.find("noisy.png misses its limits against ref.exr: indirect.relmse is "),
              std::string::npos)
        << fails.err;
    const json report = json::parse(fails.out);
    EXPECT_EQ(schema_error(load_schema("render"), report), "");
    EXPECT_EQ(report["comparison"]["fail"][0]["met"], true);
    EXPECT_EQ(report["comparison"]["fail"][1]["met"], false);
    EXPECT_TRUE(exists("noisy.png")) << "a picture is written, good or bad";
}

TEST_F(Render, AReferenceThatCannotServe) {
    ASSERT_EQ(render("ref.png").exit_code, 0);
    write_file(path("no.exr"), "no picture");
    const Outcome layer = render("out.png", {"--compare", "ref.png", "--fail", "indirect.relmse=1"});
    EXPECT_EQ(layer.exit_code, 1);
    EXPECT_NE(layer.err.find("ref.png has no layer 'indirect'"), std::string::npos) << layer.err;
    const Outcome size = render("out.png", {"--compare", "ref.png", "--size", "20x20"});
    EXPECT_EQ(size.exit_code, 1);
    EXPECT_NE(size.err.find("give --size 48x32"), std::string::npos) << size.err;
    EXPECT_EQ(render("out.png", {"--compare", "no.exr"}).exit_code, 3);
    EXPECT_EQ(render("out.png", {"--compare", "none.exr"}).exit_code, 2);
    EXPECT_FALSE(exists("out.png"));
    EXPECT_EQ(render("ref.png", {"--compare", "ref.png"}).exit_code, 1) << "it would be gone";
    EXPECT_EQ(render("out.png", {"--compare", "ref.png", "--fail", "psnr=30"}).exit_code, 0);
}

TEST_F(Render, OtherPicturesBesideAPng) {
    ASSERT_EQ(render("out.png", {"--aovs"}).exit_code, 0);
    for (const char* const name : {"direct", "indirect", "normal", "depth", "kind"}) {
        const std::string file = std::string("out.") + name + ".png";
        ASSERT_TRUE(exists(file));
        EXPECT_EQ(pixels(file).size(), 48U * 32);
    }
}

TEST_F(Render, AMapThatCanHardlyBeTheNodes) {
    bake();
    const Outcome right = render("right.png", {"--map", "ball=ball.spa"});
    ASSERT_EQ(right.exit_code, 0) << right.err;
    EXPECT_EQ(right.err.find("does not fit"), std::string::npos) << right.err;
    const Outcome wrong = render("wrong.png", {"--map", "floor=ball.spa"});
    EXPECT_EQ(wrong.exit_code, 0) << wrong.err;
    EXPECT_NE(wrong.err.find("ball.spa does not fit node 'floor'"), std::string::npos) << wrong.err;
}

TEST_F(Render, NamesThatThereAreNot) {
    write_file(path("ball.spa"), "not looked at");
    const Outcome node = render("out.png", {"--map", "bal=ball.spa"});
    EXPECT_EQ(node.exit_code, 1);
    EXPECT_NE(node.err.find("there is no node 'bal' in scene.obj; did you mean 'ball'?"), std::string::npos)
        << node.err;
    const Outcome camera = render("out.png", {"--camera", "1"});
    EXPECT_EQ(camera.exit_code, 1);
    EXPECT_NE(camera.err.find("no camera '1' in scene.obj"), std::string::npos) << camera.err;
    const Outcome device = render("out.png", {"--device", "no such device"});
    EXPECT_EQ(device.exit_code, 1);
    EXPECT_NE(device.err.find("no such device"), std::string::npos) << device.err;
    EXPECT_EQ(render("out.png", {"--map", "ball=ball.spa"}).exit_code, 3) << "not a map";
    EXPECT_EQ(render("out.png", {"--map", "ball=none.spa"}).exit_code, 2);
    EXPECT_FALSE(exists("out.png"));
}

TEST_F(Render, NothingIsHalfWritten) {
    EXPECT_EQ(render("none/out.png").exit_code, 2);
    std::filesystem::create_directory(path("out.depth.png"));
    const Outcome outcome = render("out.png", {"--aovs"});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_NE(outcome.err.find("out.depth.png"), std::string::npos) << outcome.err;
    EXPECT_EQ(folder_.names(), (std::vector<std::string>{"ball.obj", "out.depth.png", "scene.obj"}));
}

TEST_F(Render, AnInterruptLeavesNothingBehind) {
    write_file(path("out.exr"), "as it was");
    // The first words on standard error are about the camera, before the first ray.
    const Outcome outcome =
        interrupt_spa({"render", "scene.obj", "-o", "out.exr", "--size", "2000x2000", "--samples", "100000"},
                      folder_.path(), SIGINT);
    EXPECT_EQ(outcome.signal, SIGINT) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_NE(outcome.err.find("spa: interrupted; nothing was written"), std::string::npos) << outcome.err;
    EXPECT_EQ(folder_.names(), (std::vector<std::string>{"ball.obj", "out.exr", "scene.obj"}));
    EXPECT_EQ(read_file(path("out.exr")), "as it was");
}

TEST_F(Render, WithoutADriverItSaysWhatToInstall) {
    const Environment none("VK_DRIVER_FILES", "/nonexistent/driver.json");
    const Outcome outcome = render("out.png");
    EXPECT_EQ(outcome.exit_code, 5) << outcome.err;
    EXPECT_NE(outcome.err.find("install"), std::string::npos) << outcome.err;
    EXPECT_FALSE(exists("out.png"));
}

struct BadRender {
    Arguments arguments;
    const char* message;
};
void PrintTo(const BadRender& bad, std::ostream* out) { *out << bad.message; }

class RenderUsage : public testing::TestWithParam<BadRender> {};

// Before a device is looked for or a file is read.
TEST_P(RenderUsage, IsRefusedWithAMessage) {
    const TemporaryFolder folder;
    write_file(folder.path() / "in.glb", "not looked at");
    Arguments arguments{"render"};
    arguments.insert(arguments.end(), GetParam().arguments.begin(), GetParam().arguments.end());
    const Outcome outcome = run_spa(arguments, folder.path());
    EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_NE(outcome.err.find(GetParam().message), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find("see 'spa help render'"), std::string::npos) << outcome.err;
    EXPECT_EQ(folder.names(), std::vector<std::string>{"in.glb"});
}

BadRender bad(const Arguments& more, const char* message) {
    Arguments arguments{"in.glb", "-o", "out.png"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return {arguments, message};
}

INSTANTIATE_TEST_SUITE_P(
    Arguments, RenderUsage,
    testing::Values(BadRender{{}, "SCENE is required"}, BadRender{{"in.glb"}, "--output is required"},
                    BadRender{{"-", "-o", "out.png"}, "standard input"},
                    BadRender{{"in.glb", "-o", "out.jpg"}, "neither .exr nor .png"},
                    BadRender{{"in.glb", "-o", "in.glb"}, "neither .exr nor .png"},
                    bad({"--compare", "in.glb", "--difference", "out.png"}, "would be written twice"),
                    bad({"--size", "960"}, "is not WIDTHxHEIGHT"), bad({"--size", "0x9"}, "--size (width)"),
                    bad({"--size", "16384x16384"}, "more than 67108864 pixels"),
                    bad({"--samples", "-1"}, "--samples"), bad({"--antialias", "0"}, "--antialias"),
                    bad({"--seed", "x"}, "--seed"), bad({"--exposure", "bright"}, "--exposure"),
                    bad({"--layers", "0"}, "--layers"), bad({"--map", "boot"}, "is not [NODE=]FILE.spa"),
                    bad({"--map", "=boot.spa"}, "is not [NODE=]FILE.spa"),
                    bad({"--map", "a=a.spa", "--map", "a=b.spa"}, "given twice"),
                    bad({"--map", "a.spa", "--map", "b.spa"}, "two maps without NODE"),
                    bad({"--time", "-1"}, "--time"), bad({"--frames", "65"}, "--frames"),
                    bad({"--frames", "8"}, "no ray meets a map"),
                    bad({"--frames", "8", "--map", "a.spa", "--time", "1"}, "exclude each other"),
                    bad({"--frames", "8", "--map", "a.spa", "--compare", "a.exr"}, "exclude each other"),
                    bad({"--plan", "p.json", "--time", "1"}, "for the scene at rest"),
                    bad({"--plan", "p.json", "--frames", "8"}, "for the scene at rest"),
                    bad({"--primary", "both"}, "is not one of triangles, maps"),
                    bad({"--method", "sphere", "--test-rays", "1"}, "sphere has none"),
                    bad({"--test-rays", "1"}, "projective has none"),
                    bad({"--method", "fan", "--test-rays", "0"}, "from 1 to 1024"),
                    bad({"--method", "march", "--test-rays", "by-distance"}, "for --method fan"),
                    bad({"--reference", "--shadow", "maps"}, "contradicts --reference"),
                    bad({"--difference", "d.png"}, "needs --compare"),
                    bad({"--fail", "relmse=1"}, "needs --compare"),
                    bad({"--compare", "a.exr", "--fail", "flip=1"}, "out of relmse, rmse, psnr, ssim"),
                    bad({"--backend", "cpu"}, "is not one of pipeline, query")));

} // namespace
} // namespace spa::test
