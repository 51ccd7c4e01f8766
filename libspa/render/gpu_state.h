// SPDX-License-Identifier: Apache-2.0
// What a Gpu is made of, for the renderer's own files.
#pragma once

#include "device_list.h"
#include "functions.h"
#include "gpu.h"

#include "../vulkan/hit_group.h"

#include <memory>
#include <optional>
#include <vector>

namespace spa::render {

class Kernel;

// Compiled shaders (kernel.h): compiling them takes longer than a small frame.
struct CachedKernel {
    bool pipeline = false;
    vulkan::TraceConstants tracing;
    std::shared_ptr<Kernel> kernel;
};

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
    std::vector<CachedKernel> kernels;    // gone before the Gpu is
};

} // namespace spa::render
