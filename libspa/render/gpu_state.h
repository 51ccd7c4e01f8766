// SPDX-License-Identifier: Apache-2.0
// What a Gpu is made of, for the renderer's own files.
#pragma once

#include "device_list.h"
#include "functions.h"
#include "gpu.h"

#include <optional>

namespace spa::render {

struct Gpu::State {
    explicit State(const GpuOptions& options);
    ~State();
    State(const State&) = delete;
    State& operator=(const State&) = delete;

    std::vector<std::string> own_messages;
    std::vector<std::string>* messages; // where they are
    Instance instance;
    FoundDevice chosen;
    vulkan::Tracing tracing;
    VkDevice device = VK_NULL_HANDLE;
    VkQueue queue = VK_NULL_HANDLE;
    Functions call;
    VkPhysicalDeviceRayTracingPipelinePropertiesKHR pipeline_limits{};
    VkPhysicalDeviceLimits limits{};
    std::optional<vulkan::Device> loader; // the device as libspa/vulkan sees it
};

} // namespace spa::render
