// SPDX-License-Identifier: Apache-2.0
#include "gpu_state.h"

namespace spa::render {
namespace {

FoundDevice choose(const Instance& instance, const GpuOptions& options) {
    std::vector<FoundDevice> devices = find_devices(instance, options.tracing);
    std::vector<DeviceEntry> entries;
    entries.reserve(devices.size());
    for (const FoundDevice& device : devices) entries.push_back(device.entry);
    return devices[choose_device(entries, options.device)];
}

VkDevice create_device(const FoundDevice& chosen, vulkan::Tracing tracing) {
    const float priority = 1;
    VkDeviceQueueCreateInfo queue{};
    queue.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
    queue.queueFamilyIndex = chosen.queue_family;
    queue.queueCount = 1;
    queue.pQueuePriorities = &priority;
    vulkan::DeviceFeatures features(tracing);
    const std::vector<const char*> extensions = vulkan::device_extensions(tracing);
    VkDeviceCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
    info.pNext = features.chain();
    info.queueCreateInfoCount = 1;
    info.pQueueCreateInfos = &queue;
    info.enabledExtensionCount = std::uint32_t(extensions.size());
    info.ppEnabledExtensionNames = extensions.data();
    VkDevice device = VK_NULL_HANDLE;
    vulkan::check(vkCreateDevice(chosen.handle, &info, nullptr, &device), "vkCreateDevice");
    return device;
}

} // namespace

Gpu::State::State(const GpuOptions& options)
    : messages(options.messages == nullptr ? &own_messages : options.messages),
      instance(options.validation ? messages : nullptr), chosen(choose(instance, options)),
      tracing(options.tracing) {
    device = create_device(chosen, tracing);
    try {
        vkGetDeviceQueue(device, chosen.queue_family, 0, &queue);
        call = load_functions(vkGetDeviceProcAddr, device, tracing.pipelines);
        pipeline_limits.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_RAY_TRACING_PIPELINE_PROPERTIES_KHR;
        VkPhysicalDeviceProperties2 properties{};
        properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
        if (tracing.pipelines) properties.pNext = &pipeline_limits;
        vkGetPhysicalDeviceProperties2(chosen.handle, &properties);
        limits = properties.properties.limits;
        loader.emplace(vulkan::DeviceInfo{vkGetInstanceProcAddr, instance.handle(), chosen.handle, device,
                                          nullptr, nullptr});
    } catch (...) {
        vkDestroyDevice(device, nullptr);
        throw;
    }
}

Gpu::State::~State() {
    loader.reset();
    vkDestroyDevice(device, nullptr);
}

Gpu::Gpu(const GpuOptions& options) : state_(std::make_unique<State>(options)) {}
Gpu::~Gpu() { state_->kernels.clear(); } // they know this Gpu

const vulkan::Device& Gpu::device() const { return *state_->loader; }
VkQueue Gpu::queue() const { return state_->queue; }
std::uint32_t Gpu::queue_family() const { return state_->chosen.queue_family; }
const DeviceEntry& Gpu::entry() const { return state_->chosen.entry; }
bool Gpu::validated() const { return state_->instance.validated(); }
const std::vector<std::string>& Gpu::messages() const { return *state_->messages; }

} // namespace spa::render
