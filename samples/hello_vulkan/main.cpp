// SPDX-License-Identifier: Apache-2.0
// The least program that traces a `.spa` file on a Vulkan device, without a window:
//
//   hello_vulkan MAP.spa OUT.png
//
// What is worth copying is in draw(); the numbers are those of ../../libspa/vulkan/map_object.h.
#include "../../formats/container/reader.h"
#include "../../libspa/core/error.h"
#include "../../libspa/mesh/model.h"
#include "../../libspa/vulkan/map_object.h"
#include "../../libspa/vulkan/submit.h"
#include "../../libspa/vulkan/top_level.h"
#include "../png.h"

#include <spirv/hello.comp.h>

#include <vulkan/vulkan.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

namespace {

using namespace spa; // NOLINT(google-build-using-namespace)

constexpr std::uint32_t width = 640;
constexpr std::uint32_t height = 640;
constexpr vulkan::Tracing by_queries{false, true};

// An instance, the first device that can trace rays, and a queue of it that can compute.
class Application {
public:
    Application() {
        try {
            create_instance();
            choose_device();
        } catch (...) {
            destroy();
            throw;
        }
    }
    ~Application() { destroy(); }
    Application(const Application&) = delete;
    Application& operator=(const Application&) = delete;

    [[nodiscard]] vulkan::DeviceInfo info() const {
        return {vkGetInstanceProcAddr, instance_, physical_device_, device_, nullptr, nullptr};
    }
    [[nodiscard]] VkDevice device() const { return device_; }
    [[nodiscard]] VkQueue queue() const { return queue_; }
    [[nodiscard]] std::uint32_t queue_family() const { return queue_family_; }

private:
    void create_instance() {
        VkApplicationInfo application{};
        application.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
        application.apiVersion = VK_API_VERSION_1_2;
        VkInstanceCreateInfo info{};
        info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
        info.pApplicationInfo = &application;
        vulkan::check(vkCreateInstance(&info, nullptr, &instance_), "vkCreateInstance");
    }

    void choose_device() {
        std::uint32_t count = 0;
        vulkan::check(vkEnumeratePhysicalDevices(instance_, &count, nullptr), "vkEnumeratePhysicalDevices");
        std::vector<VkPhysicalDevice> devices(count);
        vulkan::check(vkEnumeratePhysicalDevices(instance_, &count, devices.data()),
                      "vkEnumeratePhysicalDevices");
        std::string lacking = "there is no Vulkan device";
        for (const VkPhysicalDevice device : devices) {
            const std::string missing = vulkan::missing(vkGetInstanceProcAddr, instance_, device, by_queries);
            if (missing.empty()) return create_device(device);
            lacking = "the Vulkan device lacks " + missing;
        }
        throw Error(ExitCode::unsupported, lacking);
    }

    // 1.
    void create_device(VkPhysicalDevice physical_device) {
        physical_device_ = physical_device;
        std::uint32_t count = 0;
        vkGetPhysicalDeviceQueueFamilyProperties(physical_device, &count, nullptr);
        std::vector<VkQueueFamilyProperties> families(count);
        vkGetPhysicalDeviceQueueFamilyProperties(physical_device, &count, families.data());
        while (queue_family_ + 1 < count && (families[queue_family_].queueFlags & VK_QUEUE_COMPUTE_BIT) == 0)
            ++queue_family_;

        const float priority = 1;
        VkDeviceQueueCreateInfo queue{};
        queue.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
        queue.queueFamilyIndex = queue_family_;
        queue.queueCount = 1;
        queue.pQueuePriorities = &priority;
        const std::vector<const char*> extensions = vulkan::device_extensions(by_queries);
        vulkan::DeviceFeatures features(by_queries);
        VkDeviceCreateInfo info{};
        info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
        info.pNext = features.chain();
        info.queueCreateInfoCount = 1;
        info.pQueueCreateInfos = &queue;
        info.enabledExtensionCount = std::uint32_t(extensions.size());
        info.ppEnabledExtensionNames = extensions.data();
        vulkan::check(vkCreateDevice(physical_device, &info, nullptr, &device_), "vkCreateDevice");
        vkGetDeviceQueue(device_, queue_family_, 0, &queue_);
    }

    void destroy() {
        if (device_ != VK_NULL_HANDLE) vkDestroyDevice(device_, nullptr);
        if (instance_ != VK_NULL_HANDLE) vkDestroyInstance(instance_, nullptr);
    }

    VkInstance instance_ = VK_NULL_HANDLE;
    VkPhysicalDevice physical_device_ = VK_NULL_HANDLE;
    VkDevice device_ = VK_NULL_HANDLE;
    VkQueue queue_ = VK_NULL_HANDLE;
    std::uint32_t queue_family_ = 0;
};

// The push constants of hello.comp.
struct Parameters {
    VkDeviceAddress scene, records, pixels;
    std::array<std::uint32_t, 2> size;
    Vec3f eye, right, up, forward;
};

// A view of a sphere from the front, the left and above.
void look_at(Vec3d center, double radius, Parameters& parameters) {
    const Vec3d eye = center + Vec3d{-1.1, 0.9, 2.4} * radius;
    const Vec3d forward = normalize(center - eye);
    const Vec3d right = normalize(cross(forward, {0, 1, 0}));
    parameters.eye = to_float(eye);
    parameters.forward = to_float(forward * 2.6);
    parameters.right = to_float(right);
    parameters.up = to_float(cross(right, forward));
}

class Kernel {
public:
    explicit Kernel(VkDevice device) : device_(device) {
        VkShaderModuleCreateInfo code{};
        code.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
        code.codeSize = sizeof hello_comp;
        code.pCode = hello_comp;
        const VkPushConstantRange range{VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof(Parameters)};
        VkPipelineLayoutCreateInfo layout{};
        layout.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
        layout.pushConstantRangeCount = 1;
        layout.pPushConstantRanges = &range;
        vulkan::check(vkCreateShaderModule(device, &code, nullptr, &module_), "vkCreateShaderModule");
        vulkan::check(vkCreatePipelineLayout(device, &layout, nullptr, &layout_), "vkCreatePipelineLayout");
        VkComputePipelineCreateInfo info{};
        info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
        info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
        info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
        info.stage.module = module_;
        info.stage.pName = "main";
        info.layout = layout_;
        vulkan::check(vkCreateComputePipelines(device, nullptr, 1, &info, nullptr, &pipeline_),
                      "vkCreateComputePipelines");
    }
    ~Kernel() {
        vkDestroyPipeline(device_, pipeline_, nullptr);
        vkDestroyPipelineLayout(device_, layout_, nullptr);
        vkDestroyShaderModule(device_, module_, nullptr);
    }
    Kernel(const Kernel&) = delete;
    Kernel& operator=(const Kernel&) = delete;

    void record(VkCommandBuffer commands, const Parameters& parameters) const {
        vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_);
        vkCmdPushConstants(commands, layout_, VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof parameters, &parameters);
        vkCmdDispatch(commands, (width + 7) / 8, (height + 7) / 8, 1);
        VkMemoryBarrier barrier{};
        barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
        barrier.srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT;
        barrier.dstAccessMask = VK_ACCESS_HOST_READ_BIT;
        vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_PIPELINE_STAGE_HOST_BIT, 0, 1,
                             &barrier, 0, nullptr, 0, nullptr);
    }

private:
    VkDevice device_;
    VkShaderModule module_ = VK_NULL_HANDLE;
    VkPipelineLayout layout_ = VK_NULL_HANDLE;
    VkPipeline pipeline_ = VK_NULL_HANDLE;
};

void write(const vulkan::Buffer& pixels, const char* path) {
    Image image{width, height, {}};
    for (std::size_t i = 0; i < std::size_t(width) * height; ++i) {
        Vec3f color;
        std::memcpy(&color, pixels.bytes().data() + i * sizeof color, sizeof color);
        image.pixels.push_back(
            {linear_to_srgb(color.x), linear_to_srgb(color.y), linear_to_srgb(color.z), std::uint8_t(255)});
    }
    const std::vector<std::byte> png = samples::encode_png(image, path);
    std::ofstream stream(path, std::ios::binary);
    stream.write(reinterpret_cast<const char*>(png.data()), std::streamsize(png.size()));
    if (!stream.flush())
        throw Error(ExitCode::input_output, std::string(path) + ": cannot be written; is the folder there?");
}

void draw(const char* map_path, const char* out) {
    const Application application; // 1.
    const vulkan::Device device(application.info());

    container::File file; // 2.
    const container::Status status = container::open(map_path, file);
    if (!status.ok()) throw Error(container::exit_code(status.issue), container::describe(status, map_path));
    vulkan::MapObject map(device, file.map());

    std::array<vulkan::MapObject*, 1> objects{&map}; // 3., 4.
    vulkan::load(device, application.queue(), application.queue_family(), objects);

    std::vector<VkAccelerationStructureInstanceKHR> instances; // 5.
    std::vector<vulkan::ShaderRecord> records;
    for (std::uint32_t part = 0; part < map.part_count(); ++part) {
        vulkan::InstanceOptions options;
        options.custom_index = part;
        instances.push_back(map.instance(part, {}, options));
        records.push_back(map.shader_record(part));
    }
    vulkan::TopLevel scene(device, instances);

    const vulkan::Buffer table(device, records.size() * sizeof records[0], // 6b.
                               VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, vulkan::MemoryUse::upload);
    std::memcpy(table.bytes().data(), records.data(), table.bytes().size());
    const vulkan::Buffer pixels(device, sizeof(Vec3f) * width * height, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                                vulkan::MemoryUse::readback);
    Parameters parameters{};
    parameters.scene = scene.structure().address();
    parameters.records = table.address();
    parameters.pixels = pixels.address();
    parameters.size = {width, height};
    const Part& first = file.map().parts.front();
    look_at(first.center, first.radius * std::cbrt(std::abs(determinant(first.frame))), parameters);
    const Kernel kernel(application.device());
    vulkan::submit_and_wait(device, application.queue(), application.queue_family(),
                            [&](VkCommandBuffer commands) {
                                scene.record(commands);
                                kernel.record(commands, parameters);
                            });
    write(pixels, out);
}

} // namespace

int main(int argc, char** argv) {
    if (argc != 3) {
        std::fputs("hello_vulkan MAP.spa OUT.png\n", stderr);
        return int(ExitCode::usage);
    }
    try {
        draw(argv[1], argv[2]);
    } catch (const Error& error) {
        std::fprintf(stderr, "hello_vulkan: %s\n", error.what());
        return int(error.code());
    } catch (const std::exception& error) {
        std::fprintf(stderr, "hello_vulkan: %s\n", error.what());
        return int(ExitCode::internal);
    }
    return int(ExitCode::ok);
}
