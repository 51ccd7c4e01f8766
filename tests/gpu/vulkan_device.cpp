// SPDX-License-Identifier: Apache-2.0
#include "vulkan_device.h"

#include "../../libspa/core/error.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <optional>

namespace spa::test {
namespace {

constexpr const char* validation_layer = "VK_LAYER_KHRONOS_validation";

VKAPI_ATTR VkBool32 VKAPI_CALL write_down(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                          VkDebugUtilsMessageTypeFlagsEXT,
                                          const VkDebugUtilsMessengerCallbackDataEXT* data, void* user) {
    static_cast<ValidationLog*>(user)->emplace_back(data->pMessage);
    return VK_FALSE;
}

// Only what the layer has to say about the use of Vulkan: the loader's own messages, about drivers for
// devices that are not there, are no concern of a test.
VkDebugUtilsMessengerCreateInfoEXT messenger_info(ValidationLog& log) {
    VkDebugUtilsMessengerCreateInfoEXT info{};
    info.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT;
    info.messageSeverity =
        VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    info.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT;
    info.pfnUserCallback = write_down;
    info.pUserData = &log;
    return info;
}

bool layer_is_installed() {
    std::uint32_t count = 0;
    check(vkEnumerateInstanceLayerProperties(&count, nullptr), "vkEnumerateInstanceLayerProperties");
    std::vector<VkLayerProperties> layers(count);
    check(vkEnumerateInstanceLayerProperties(&count, layers.data()), "vkEnumerateInstanceLayerProperties");
    return std::any_of(layers.begin(), layers.end(), [](const VkLayerProperties& layer) {
        return std::strcmp(layer.layerName, validation_layer) == 0;
    });
}

// Null if the instance lacks it.
template <class Function>
Function instance_function(VkInstance instance, const char* name) {
    return reinterpret_cast<Function>(vkGetInstanceProcAddr(instance, name));
}

std::vector<VkPhysicalDevice> devices_of(VkInstance instance) {
    std::uint32_t count = 0;
    check(vkEnumeratePhysicalDevices(instance, &count, nullptr), "vkEnumeratePhysicalDevices");
    std::vector<VkPhysicalDevice> devices(count);
    check(vkEnumeratePhysicalDevices(instance, &count, devices.data()), "vkEnumeratePhysicalDevices");
    return devices;
}

std::optional<std::uint32_t> compute_family(VkPhysicalDevice device) {
    std::uint32_t count = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(device, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vkGetPhysicalDeviceQueueFamilyProperties(device, &count, families.data());
    for (std::uint32_t family = 0; family < count; ++family)
        if ((families[family].queueFlags & VK_QUEUE_COMPUTE_BIT) != 0) return family;
    return std::nullopt;
}

bool traces_rays(vulkan::Tracing tracing) { return tracing.pipelines || tracing.queries; }

} // namespace

void check(VkResult result, const char* what) {
    if (result == VK_SUCCESS) return;
    throw Error(ExitCode::internal,
                std::string(what) + " failed with VkResult " + std::to_string(int(result)));
}

VulkanDevice::VulkanDevice(ValidationLog& log, vulkan::Tracing tracing) {
    try {
        create_instance(log);
        choose_device(tracing);
        create_device(tracing);
    } catch (...) {
        destroy();
        throw;
    }
}

VulkanDevice::~VulkanDevice() { destroy(); }

const char* other_map_shaders() { return std::getenv("SPA_MAP_SHADERS"); }

void VulkanDevice::destroy() {
    if (device_ != VK_NULL_HANDLE) vkDestroyDevice(device_, nullptr);
    const auto destroy_messenger = messenger_ == VK_NULL_HANDLE
                                       ? nullptr
                                       : instance_function<PFN_vkDestroyDebugUtilsMessengerEXT>(
                                             instance_, "vkDestroyDebugUtilsMessengerEXT");
    if (destroy_messenger != nullptr) destroy_messenger(instance_, messenger_, nullptr);
    if (instance_ != VK_NULL_HANDLE) vkDestroyInstance(instance_, nullptr);
}

void VulkanDevice::create_instance(ValidationLog& log) {
    validated_ = layer_is_installed();
    const VkDebugUtilsMessengerCreateInfoEXT messenger = messenger_info(log);

    // Missing barriers and read-backs show only when asked for.
    const VkValidationFeatureEnableEXT synchronization =
        VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
    VkValidationFeaturesEXT features{};
    features.sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT;
    features.pNext = &messenger; // for vkCreateInstance and vkDestroyInstance themselves
    features.enabledValidationFeatureCount = 1;
    features.pEnabledValidationFeatures = &synchronization;

    VkApplicationInfo application{};
    application.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
    application.apiVersion = other_map_shaders() ? VK_API_VERSION_1_3 : VK_API_VERSION_1_2;
    VkInstanceCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
    info.pApplicationInfo = &application;
    const char* const extension = VK_EXT_DEBUG_UTILS_EXTENSION_NAME;
    if (validated_) {
        info.pNext = &features;
        info.enabledLayerCount = 1;
        info.ppEnabledLayerNames = &validation_layer;
        info.enabledExtensionCount = 1;
        info.ppEnabledExtensionNames = &extension;
    }
    const VkResult result = vkCreateInstance(&info, nullptr, &instance_);
    if (result == VK_ERROR_INCOMPATIBLE_DRIVER)
        throw Error(ExitCode::unsupported, "there is no Vulkan driver here");
    check(result, "vkCreateInstance");

    if (!validated_) return;
    const auto create =
        instance_function<PFN_vkCreateDebugUtilsMessengerEXT>(instance_, "vkCreateDebugUtilsMessengerEXT");
    if (create == nullptr) throw Error(ExitCode::internal, "vkCreateDebugUtilsMessengerEXT is missing");
    check(create(instance_, &messenger, nullptr, &messenger_), "vkCreateDebugUtilsMessengerEXT");
}

void VulkanDevice::choose_device(vulkan::Tracing tracing) {
    std::string missing;
    const bool any = std::getenv("SPA_VULKAN_ANY_DEVICE") != nullptr;
    for (const VkPhysicalDevice device : devices_of(instance_)) {
        VkPhysicalDeviceDriverProperties driver{};
        driver.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES;
        VkPhysicalDeviceProperties2 properties{};
        properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
        properties.pNext = &driver;
        vkGetPhysicalDeviceProperties2(device, &properties);
        const auto family = compute_family(device);
        if (!family || properties.properties.apiVersion < VK_API_VERSION_1_2) continue;
        if (!any && driver.driverID != VK_DRIVER_ID_MESA_LLVMPIPE) continue;
        if (traces_rays(tracing)) {
            missing = vulkan::missing(vkGetInstanceProcAddr, instance_, device, tracing);
            if (!missing.empty()) continue;
        }
        physical_device_ = device;
        queue_family_ = *family;
        limits_ = properties.properties.limits;
        description_ = std::string(properties.properties.deviceName) + ", " + driver.driverName + " " +
                       driver.driverInfo + (validated_ ? ", validated" : ", without the validation layer");
        return;
    }
    if (!missing.empty()) throw Error(ExitCode::unsupported, "the Vulkan device here lacks " + missing);
    throw Error(ExitCode::unsupported, any ? "no Vulkan device here has a compute queue and Vulkan 1.2"
                                           : "Mesa's software Vulkan, lavapipe, is not here");
}

void VulkanDevice::create_device(vulkan::Tracing tracing) {
    const float priority = 1;
    VkDeviceQueueCreateInfo queue{};
    queue.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
    queue.queueFamilyIndex = queue_family_;
    queue.queueCount = 1;
    queue.pQueuePriorities = &priority;
    VkDeviceCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
    info.queueCreateInfoCount = 1;
    info.pQueueCreateInfos = &queue;
    vulkan::DeviceFeatures features(tracing);
    const std::vector<const char*> extensions = vulkan::device_extensions(tracing);
    if (traces_rays(tracing)) {
        // For addresses, which GLSL has as two words.
        features.features.features.shaderInt64 = other_map_shaders() ? VK_TRUE : VK_FALSE;
        info.pNext = features.chain();
        info.enabledExtensionCount = std::uint32_t(extensions.size());
        info.ppEnabledExtensionNames = extensions.data();
    }
    check(vkCreateDevice(physical_device_, &info, nullptr, &device_), "vkCreateDevice");
    vkGetDeviceQueue(device_, queue_family_, 0, &queue_);
}

std::uint32_t VulkanDevice::host_memory_type(std::uint32_t allowed) const {
    VkPhysicalDeviceMemoryProperties memory{};
    vkGetPhysicalDeviceMemoryProperties(physical_device_, &memory);
    const VkMemoryPropertyFlags wanted =
        VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    for (std::uint32_t type = 0; type < memory.memoryTypeCount; ++type)
        if ((allowed >> type & 1U) != 0 && (memory.memoryTypes[type].propertyFlags & wanted) == wanted)
            return type;
    throw Error(ExitCode::internal, "no memory type suits, against the Vulkan specification");
}

} // namespace spa::test
