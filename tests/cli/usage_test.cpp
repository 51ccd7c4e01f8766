// SPDX-License-Identifier: Apache-2.0
// What is wrong with a command line ends in exit code 1, before anything is read or written.
#include "process.h"

#include <gtest/gtest.h>

#include <ostream>

namespace spa::test {
namespace {

struct BadUsage {
    std::vector<std::string> arguments;
    const char* message; // a part of what stderr must say
};

std::ostream& operator<<(std::ostream& out, const BadUsage& usage) {
    for (const std::string& argument : usage.arguments) out << argument << ' ';
    return out;
}

class Usage : public testing::TestWithParam<BadUsage> {};

TEST_P(Usage, IsRefusedWithAMessage) {
    const TemporaryFolder folder;
    write_file(folder.path() / "in.glb", "not looked at");
    const Outcome outcome = run_spa(GetParam().arguments, folder.path());
    EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(outcome.err.rfind("spa: ", 0), 0U) << outcome.err;
    EXPECT_NE(outcome.err.find(GetParam().message), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find("see 'spa help"), std::string::npos) << outcome.err;
    EXPECT_EQ(folder.names(), std::vector<std::string>{"in.glb"});
}

std::vector<std::string> bake(const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"bake", "in.glb", "-o", "out.spa"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}

INSTANTIATE_TEST_SUITE_P(
    Command, Usage,
    testing::Values(BadUsage{{"bak"}, "did you mean 'bake'"},
                    BadUsage{{"--nonsense"}, "there is no verb '--nonsense'"},
                    BadUsage{{"help", "nothing"}, "no verb 'nothing'"}, BadUsage{{"bake"}, "IN is required"},
                    BadUsage{{"bake", "in.glb"}, "--output is required"},
                    BadUsage{{"inspect"}, "FILE is required"},
                    BadUsage{{"extract", "in.glb"}, "--output is required"},
                    BadUsage{{"sample", "cube"}, "--output is required"},
                    BadUsage{{"inspect", "in.glb", "extra"}, "extra"},
                    BadUsage{{"inspect", "in.glb", "--format", "xml"}, "'xml' is not one of text, json"},
                    BadUsage{{"inspect", "in.glb", "--sheet", "in.glb"}, "both input and output"},
                    BadUsage{{"sample", "cubes", "-o", "a.glb"}, "there is no sample 'cubes'"},
                    BadUsage{{"sample", "cube", "--level", "7", "-o", "a.glb"}, "from 0 to 6"}));

INSTANTIATE_TEST_SUITE_P(
    Bake, Usage,
    testing::Values(BadUsage{{"bake", "in.glb", "-o", "in.glb"}, "both input and output"},
                    BadUsage{{"bake", "-", "-o", "out.spa"}, "standard input"},
                    BadUsage{{"bake", "in.glb", "-o", "-"}, "standard output"},
                    BadUsage{bake({"--no-such-option"}), "--no-such-option"},
                    BadUsage{bake({"--depth", "u9"}), "'u9' is not one of u8, u16, f32"},
                    BadUsage{bake({"--normals", "rgba8"}), "'rgba8' is not one of oct8, oct16, rgb8"},
                    BadUsage{bake({"--mapping", "cube"}), "'cube' is not one of"},
                    BadUsage{bake({"--size", "257"}), "give 256 or 258"},
                    BadUsage{bake({"--size", "0"}), "from 2 to 8192"},
                    BadUsage{bake({"--size", "-256"}), "'-256'"},
                    BadUsage{bake({"--size", "256.0"}), "'256.0'"},
                    BadUsage{bake({"--size", "99999999999999999999"}), "from 2 to 8192"},
                    BadUsage{bake({"--size", "640x480"}), "add --mapping latlong"},
                    BadUsage{bake({"--color-size", "9000"}), "--color-size"},
                    BadUsage{bake({"--mapping", "latlong", "--size", "0x480"}), "width"},
                    BadUsage{bake({"--mapping", "latlong", "--size", "640x"}), "height"},
                    BadUsage{bake({"--mapping", "latlong", "--size", "641"}), "WIDTHxHEIGHT"},
                    BadUsage{bake({"--layers", "0"}), "--layers"},
                    BadUsage{bake({"--samples", "9"}), "from 1 to 8"},
                    BadUsage{bake({"--threads", "two"}), "--threads"},
                    BadUsage{bake({"--compress", "gzip"}), "'gzip' is not one of zstd, none"},
                    BadUsage{bake({"--size", "64", "--size", "128"}), "--size"}));

} // namespace
} // namespace spa::test
