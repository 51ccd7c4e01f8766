// SPDX-License-Identifier: Apache-2.0
#include "../../tools/batch_arguments.h"
#include "../../tools/batch_progress.h"
#include "../../tools/memory_budget.h"

#include <gtest/gtest.h>

#include <map>

namespace spa::test {
namespace {

using tools::parse_byte_count;
using tools::parse_shard;
using tools::Shard;
using Environment = std::map<std::string, std::string>;

Shard shard(const std::string& text, const Environment& environment = {}) {
    return parse_shard(text, [&](const char* name) -> const char* {
        const auto found = environment.find(name);
        return found == environment.end() ? nullptr : found->second.c_str();
    });
}

std::string refusal(const std::string& text, const Environment& environment = {}) {
    try {
        static_cast<void>(shard(text, environment));
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::usage);
        return error.what();
    }
    return "taken";
}

void expect_shard(const Shard& given, std::uint32_t index, std::uint32_t count) {
    EXPECT_EQ(given.index, index);
    EXPECT_EQ(given.count, count);
}

TEST(ShardArgument, CountsFromOneOrFromNought) {
    expect_shard(shard("1/4"), 1, 4);
    expect_shard(shard("4/4"), 4, 4);
    expect_shard(shard("0/4"), 4, 4);
    expect_shard(shard("1/1"), 1, 1);
}

TEST(ShardArgument, WrongOnesAreRefused) {
    for (const char* text : {"", "4", "5/4", "1/0", "-1/4", "1/4/2", "a/b", "1 /4", "1/4294967296", "/"})
        EXPECT_NE(refusal(text).find("--shard"), std::string::npos) << text;
}

TEST(ShardArgument, SlurmArraysOfAnyNumbering) {
    const auto task = [](const char* id, const char* min, const char* step) {
        return Environment{{"SLURM_ARRAY_TASK_ID", id},
                           {"SLURM_ARRAY_TASK_MIN", min},
                           {"SLURM_ARRAY_TASK_STEP", step},
                           {"SLURM_ARRAY_TASK_COUNT", "4"}};
    };
    expect_shard(shard("auto", task("1", "1", "1")), 1, 4);
    expect_shard(shard("auto", task("4", "1", "1")), 4, 4);
    expect_shard(shard("auto", task("0", "0", "1")), 1, 4);
    expect_shard(shard("auto", task("30", "10", "10")), 3, 4);
    EXPECT_NE(refusal("auto", task("11", "10", "10")).find("SLURM_ARRAY_TASK_ID"), std::string::npos);
    // An array with gaps, such as 1,2,7,9, has numbers beyond its count.
    EXPECT_NE(refusal("auto", task("9", "1", "1")).find("9 is more than 4"), std::string::npos);
    EXPECT_NE(refusal("auto", {{"SLURM_ARRAY_TASK_ID", "1"}}).find("SLURM_ARRAY_TASK_COUNT"),
              std::string::npos);
}

TEST(ShardArgument, KubernetesNeedsTheCount) {
    expect_shard(shard("auto", {{"JOB_COMPLETION_INDEX", "0"}, {"SPA_SHARD_COUNT", "3"}}), 1, 3);
    expect_shard(shard("auto", {{"JOB_COMPLETION_INDEX", "2"}, {"SPA_SHARD_COUNT", "3"}}), 3, 3);
    EXPECT_NE(refusal("auto", {{"JOB_COMPLETION_INDEX", "0"}}).find("SPA_SHARD_COUNT"), std::string::npos);
}

TEST(ShardArgument, OwnVariablesComeFirst) {
    expect_shard(shard("auto", {{"SPA_SHARD_INDEX", "2"},
                                {"SPA_SHARD_COUNT", "5"},
                                {"SLURM_ARRAY_TASK_ID", "1"},
                                {"SLURM_ARRAY_TASK_MIN", "1"},
                                {"SLURM_ARRAY_TASK_COUNT", "1"}}),
                 2, 5);
    EXPECT_NE(refusal("auto").find("none of"), std::string::npos);
}

TEST(MemoryArgument, SizesWithUnits) {
    EXPECT_EQ(parse_byte_count("--memory", "512M"), std::uint64_t(512) << 20U);
    EXPECT_EQ(parse_byte_count("--memory", "8G"), std::uint64_t(8) << 30U);
    EXPECT_EQ(parse_byte_count("--memory", "1T"), std::uint64_t(1) << 40U);
    EXPECT_EQ(parse_byte_count("--memory", "4K"), 4096U);
    EXPECT_EQ(parse_byte_count("--memory", "123"), 123U);
    for (const char* text :
         {"", "0", "8GB", "G", "-1", "1.5G", "99999999999T", " 1G", "18446744073709551616"})
        EXPECT_THROW(parse_byte_count("--memory", text), Error) << text;
}

TEST(MemoryArgument, TheDefaultIsLessThanTheMachineHas) {
    EXPECT_GT(tools::default_memory_budget(), std::uint64_t(16) << 20U);
    EXPECT_LT(tools::default_memory_budget(), std::uint64_t(1) << 50U);
}

TEST(DurationText, IsShort) {
    EXPECT_EQ(tools::duration_text(0.2), "1 s");
    EXPECT_EQ(tools::duration_text(119), "119 s");
    EXPECT_EQ(tools::duration_text(150), "3 min");
    EXPECT_EQ(tools::duration_text(2 * 3600 + 5 * 60), "2 h 05 min");
}

} // namespace
} // namespace spa::test
