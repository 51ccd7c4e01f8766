// SPDX-License-Identifier: Apache-2.0
#include "bench_bake.h"

#include "../bake/bake.h"

#include <algorithm>
#include <fstream>
#include <malloc.h>
#include <string>

namespace spa::measure {
namespace {

template <class T>
std::uint64_t bytes_of(const std::vector<T>& values) {
    return values.size() * sizeof(T);
}

// A field of /proc/self/status in KiB: VmRSS is what is resident now, VmHWM its peak.
std::optional<std::uint64_t> status_bytes(const std::string& field) {
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);) {
        if (line.starts_with(field + ":")) return std::stoull(line.substr(field.size() + 1)) * 1024;
    }
    return {};
}

} // namespace

std::uint64_t model_bytes(const Model& model) {
    std::uint64_t bytes = bytes_of(model.positions) + bytes_of(model.normals) + bytes_of(model.uvs) +
                          bytes_of(model.colors) + bytes_of(model.triangles) +
                          bytes_of(model.triangle_materials) + bytes_of(model.materials);
    for (const Texture& texture : model.textures) {
        for (const Image& mip : texture.mips) bytes += bytes_of(mip.pixels);
    }
    return bytes;
}

std::optional<std::uint64_t> peak_bake_bytes(const Model& model, const bake::Options& options) {
    // Free memory that the process still holds would hide what the bake takes.
    malloc_trim(0);
    const std::optional<std::uint64_t> before = status_bytes("VmRSS");
    std::ofstream reset("/proc/self/clear_refs");
    reset << "5" << std::flush; // sets VmHWM to VmRSS; proc(5)
    if (!reset || !before) return {};
    (void)bake::bake_model(model, options);
    const std::optional<std::uint64_t> peak = status_bytes("VmHWM");
    if (!peak) return {};
    return model_bytes(model) + (std::max(*peak, *before) - *before);
}

} // namespace spa::measure
