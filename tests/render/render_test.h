// SPDX-License-Identifier: Apache-2.0
// What tests of the renderer share: a device of their own, and a failure for everything the validation layer
// says.
#pragma once

#include "../../libspa/core/error.h"
#include "../../libspa/render/render.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

namespace spa::test {

// Without Vulkan the test is skipped; with SPA_REQUIRE_VULKAN in the environment, as CI has it, it fails, and
// so it does without the validation layer.
class RenderTest : public testing::Test {
protected:
    void SetUp() override {
        const bool required = std::getenv("SPA_REQUIRE_VULKAN") != nullptr;
        render::GpuOptions options;
        options.validation = true;
        options.messages = &messages_;
        // So that results are the same everywhere.
        if (std::getenv("SPA_VULKAN_ANY_DEVICE") == nullptr) options.device = "llvmpipe";
        try {
            gpu = open(options, required);
        } catch (const Error& error) {
            if (required) FAIL() << error.what();
            GTEST_SKIP() << error.what();
        }
        RecordProperty("device", gpu->entry().name + ", " + gpu->entry().driver);
        if (required && !gpu->validated()) FAIL() << "the validation layer is not installed";
    }
    void TearDown() override {
        gpu.reset();
        for (const std::string& message : messages_) ADD_FAILURE() << message;
    }

    // Of a scene without maps.
    [[nodiscard]] render::Frame render_triangles(const Scene& scene, const render::Settings& settings,
                                                 render::FrameTimes* times = nullptr) const {
        const render::DeviceScene device_scene(*gpu, scene, {}, false);
        return render::render(*gpu, device_scene, settings, times);
    }

    std::unique_ptr<render::Gpu> gpu;
    bool has_queries = true;

private:
    // GPUs without units for rays, such as NVIDIA's H100, have pipelines and no queries.
    std::unique_ptr<render::Gpu> open(render::GpuOptions options, bool required) {
        try {
            return std::make_unique<render::Gpu>(options);
        } catch (const Error& error) {
            if (required || error.code() != ExitCode::unsupported) throw;
        }
        options.tracing.queries = has_queries = false;
        return std::make_unique<render::Gpu>(options);
    }

    std::vector<std::string> messages_;
};

} // namespace spa::test
