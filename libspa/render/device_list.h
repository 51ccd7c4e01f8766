// SPDX-License-Identifier: Apache-2.0
// A Vulkan instance and what it finds.
#pragma once

#include "gpu.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace spa::render {

class Instance {
public:
    // messages: null: without the validation layer; else where it writes, if it is installed; outlives this.
    // Throws Error{unsupported} if there is no Vulkan.
    explicit Instance(std::vector<std::string>* messages);
    ~Instance();
    Instance(const Instance&) = delete;
    Instance& operator=(const Instance&) = delete;

    [[nodiscard]] VkInstance handle() const { return instance_; }
    [[nodiscard]] bool validated() const { return validated_; }

private:
    VkInstance instance_ = VK_NULL_HANDLE;
    VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
    bool validated_ = false;
};

struct FoundDevice {
    VkPhysicalDevice handle = VK_NULL_HANDLE;
    std::uint32_t queue_family = 0; // can compute; means nothing where entry.missing names the lack of one
    DeviceEntry entry;
};

// In the order of the Vulkan loader. entry.missing: for this way to trace.
std::vector<FoundDevice> find_devices(const Instance& instance, vulkan::Tracing tracing);

// Index of the entry that GpuOptions::device asks for. Throws as Gpu does.
std::size_t choose_device(const std::vector<DeviceEntry>& entries, std::string_view device);

} // namespace spa::render
