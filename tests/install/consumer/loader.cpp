// SPDX-License-Identifier: Apache-2.0
// A program of somebody else that loads maps onto a Vulkan device: includes every installed header of the
// loader. It needs no Vulkan library to start.
#include <formats/container/reader.h>
#include <libspa/vulkan/acceleration_structure.h>
#include <libspa/vulkan/allocator.h>
#include <libspa/vulkan/buffer.h>
#include <libspa/vulkan/device.h>
#include <libspa/vulkan/functions.h>
#include <libspa/vulkan/hit_group.h>
#include <libspa/vulkan/map_object.h>
#include <libspa/vulkan/submit.h>
#include <libspa/vulkan/top_level.h>

#include <cstdio>

// What a program with a device does; compiled and linked, not called here.
VkAccelerationStructureInstanceKHR load(const spa::vulkan::DeviceInfo& info, VkQueue queue,
                                        const spa::SphericalMap& map) {
    const spa::vulkan::Device device(info);
    spa::vulkan::MapObject object(device, map);
    spa::vulkan::MapObject* const objects[] = {&object};
    spa::vulkan::load(device, queue, 0, objects);
    return object.instance(0, {});
}

int main(int argc, char**) {
    if (argc > 100) load({}, nullptr, {});
    constexpr std::uint32_t spirv_magic = 0x07230203;
    for (const auto stage : {spa::vulkan::HitStage::intersection, spa::vulkan::HitStage::closest_hit,
                             spa::vulkan::HitStage::any_hit})
        if (spa::vulkan::hit_stage_spirv(stage).front() != spirv_magic) {
            std::fputs("loader: no SPIR-V\n", stderr);
            return 1;
        }
    const spa::vulkan::TraceConstants constants;
    return spa::vulkan::specialization(constants).mapEntryCount == 5 ? 0 : 1;
}
