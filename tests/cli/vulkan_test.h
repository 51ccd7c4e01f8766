// SPDX-License-Identifier: Apache-2.0
// Tests of verbs that need a Vulkan device which traces rays.
#pragma once

#include "process.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdlib>
#include <string>

namespace spa::test {

// Without such a device the test is skipped; with SPA_REQUIRE_VULKAN in the environment, as CI has it, it
// fails.
class VulkanVerbTest : public testing::Test {
protected:
    void SetUp() override {
        const TemporaryFolder folder;
        const Outcome outcome = run_spa({"render", "--list-devices", "--format", "json"}, folder.path());
        std::string why = outcome.err;
        if (outcome.exit_code == 0) {
            const nlohmann::json devices = nlohmann::json::parse(outcome.out)["devices"];
            const bool traces = std::any_of(devices.begin(), devices.end(), [](const nlohmann::json& device) {
                return device["missing"] == "";
            });
            why = traces ? "" : "no Vulkan device here traces rays";
        }
        if (!why.empty() && std::getenv("SPA_REQUIRE_VULKAN") != nullptr) FAIL() << why;
        if (!why.empty()) GTEST_SKIP() << why;
    }
};

} // namespace spa::test
