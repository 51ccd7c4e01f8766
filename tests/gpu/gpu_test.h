// SPDX-License-Identifier: Apache-2.0
// What tests on the GPU share: a device of their own, and a failure for everything the validation layer says.
#pragma once

#include "compute.h"

#include "../../libspa/core/error.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>

namespace spa::test {

// Without Vulkan the test is skipped; with SPA_REQUIRE_VULKAN in the environment, as CI has it, it fails, and
// so it does without the validation layer.
class GpuTest : public testing::Test {
protected:
    explicit GpuTest(vulkan::Tracing tracing = {}) : tracing_(tracing) {}

    void SetUp() override {
        const bool required = std::getenv("SPA_REQUIRE_VULKAN") != nullptr;
        try {
            device = open(required);
        } catch (const Error& error) {
            if (required || error.code() != ExitCode::unsupported) FAIL() << error.what();
            GTEST_SKIP() << error.what();
        }
        RecordProperty("device", device->description());
        if (required && !device->validated()) FAIL() << device->description();
    }

    void TearDown() override {
        device.reset();
        for (const std::string& message : log_) ADD_FAILURE() << message;
    }

    [[nodiscard]] static std::filesystem::path shader(const std::string& name) {
        return std::filesystem::path(SPA_GPU_SHADERS) / (name + ".spv");
    }

    // What the device was opened with: less than was asked for where it has ray-tracing pipelines alone.
    [[nodiscard]] vulkan::Tracing tracing() const { return tracing_; }

    std::unique_ptr<VulkanDevice> device;

private:
    // GPUs without units for rays, such as NVIDIA's H100, have pipelines and no queries.
    std::unique_ptr<VulkanDevice> open(bool required) {
        try {
            return std::make_unique<VulkanDevice>(log_, tracing_);
        } catch (const Error& error) {
            if (required || error.code() != ExitCode::unsupported) throw;
            if (!tracing_.pipelines || !tracing_.queries) throw;
        }
        tracing_.queries = false;
        return std::make_unique<VulkanDevice>(log_, tracing_);
    }

    vulkan::Tracing tracing_;
    ValidationLog log_;
};

} // namespace spa::test
