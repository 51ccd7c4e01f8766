// SPDX-License-Identifier: Apache-2.0
#include "../../tools/batch_config.h"
#include "../cli/process.h"
#include "../cli/schema.h"

#include <gtest/gtest.h>

namespace spa::test {
namespace {

using tools::BatchConfig;
using tools::BatchSettings;
using tools::GivenSettings;
using tools::options_json;

BatchConfig read(const std::string& text) {
    const TemporaryFolder folder;
    write_file(folder.path() / "c.json", text);
    return tools::read_batch_config(folder.path() / "c.json");
}

std::string refusal(const std::string& text) {
    try {
        static_cast<void>(read(text));
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::invalid_data);
        return error.what();
    }
    return "taken";
}

constexpr const char* example = R"({
  "options": {"size": 128, "layers": 1},
  "patterns": [
    {"match": "heroes", "options": {"size": 512, "measure": true}},
    {"match": "*.glb", "options": {"depth": "f32"}},
    {"match": "heroes/plain.glb", "options": {"size": "64", "measure": false}}
  ]
})";

TEST(BatchConfig, LaterPatternsWinAndTheCommandLineWinsOverAll) {
    BatchSettings settings(read(example), {});
    EXPECT_EQ(options_json(settings.of("a.obj"))["size"], "128");
    EXPECT_EQ(settings.of("a.obj").options.layers, 1U);
    EXPECT_EQ(settings.of("a.obj").options.depth, ElementFormat::u16);
    const auto hero = options_json(settings.of("heroes/boot.glb"));
    EXPECT_EQ(hero["size"], "512");
    EXPECT_EQ(hero["depth"], "f32");
    EXPECT_EQ(hero["layers"], 1);
    EXPECT_EQ(hero["measure"], true);
    EXPECT_EQ(options_json(settings.of("heroes/plain.glb"))["size"], "64");
    EXPECT_EQ(options_json(settings.of("heroes/plain.glb"))["measure"], false);

    BatchSettings overruled(read(example), {{"--size", "32"}, {"--measure", "true"}});
    EXPECT_EQ(options_json(overruled.of("heroes/plain.glb"))["size"], "32");
    EXPECT_EQ(options_json(overruled.of("heroes/plain.glb"))["measure"], true);
    EXPECT_EQ(options_json(overruled.of("a.obj"))["layers"], 1);
}

TEST(BatchConfig, ExampleFollowsTheSchema) {
    EXPECT_EQ(schema_error(load_schema("batch-config"), nlohmann::json::parse(example)), "");
    EXPECT_NE(schema_error(load_schema("batch-config"), nlohmann::json::parse(R"({"option": {}})")), "");
}

TEST(BatchConfig, TheOptionsInAMapCanBePutIn) {
    const auto recorded = options_json(tools::parse_settings({{"--paper", "true"}, {"--samples", "3"}}));
    BatchSettings settings(read(nlohmann::ordered_json{{"options", recorded}}.dump()), {});
    EXPECT_EQ(options_json(settings.of("a.obj")), recorded);
}

TEST(BatchConfig, ErrorsNameThePlace) {
    const auto has = [](const std::string& text, const std::string& part) {
        EXPECT_NE(refusal(text).find(part), std::string::npos) << refusal(text);
    };
    has("{", "c.json: is not JSON");
    has("[]", "c.json: is not an object");
    has(R"({"option": {}})", "no member 'option' here; did you mean 'options'");
    has(R"({"options": {"sise": 3}})", "no option 'sise' of a bake; did you mean 'size'");
    has(R"({"options": {"output": "x"}})", "no option 'output'");
    has(R"({"options": {"size": 33}})", "options: --size: '33' is odd");
    has(R"({"options": {"size": 1.5}})", "options: --size: '1.5' is not a whole number");
    has(R"({"options": {"measure": "yes"}})", "options.measure: is true or false");
    has(R"({"patterns": {}})", "patterns: is not an array");
    has(R"({"patterns": [{"options": {}}]})", "patterns[0]: has no 'match'");
    has(R"({"patterns": [{"match": "x"}]})", "patterns[0]: has no 'options'");
    has(R"({"patterns": [{"match": "x", "options": {"layers": 0}}]})", "patterns[0].options: --layers: '0'");
    EXPECT_THROW(tools::read_batch_config("/none/c.json"), Error);
}

TEST(BatchConfig, ContradictionsNameTheAsset) {
    BatchSettings settings(read(R"({"options": {"mapping": "octahedral"}})"), {{"--size", "64x32"}});
    try {
        static_cast<void>(settings.of("props/a.obj"));
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::usage);
        EXPECT_EQ(std::string(error.what()).rfind("props/a.obj: --size", 0), 0U) << error.what();
    }
}

} // namespace
} // namespace spa::test
