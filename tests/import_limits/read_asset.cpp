// SPDX-License-Identifier: Apache-2.0
// read_asset PATH: reads a model and a scene, each in its turn, and prints what came of it, a line each, and
// how much memory the process had at most, in KiB (0 where a sanitizer makes that meaningless).
#include "../../formats/import/import.h"

#include <exception>
#include <fstream>
#include <iostream>
#include <string>

namespace {

#if defined(__SANITIZE_ADDRESS__)
constexpr bool sanitized = true;
#elif defined(__has_feature)
constexpr bool sanitized = __has_feature(address_sanitizer);
#else
constexpr bool sanitized = false;
#endif

template <class Read>
std::string outcome_of(const Read& read) {
    try {
        return read();
    } catch (const std::exception& error) {
        return error.what();
    }
}

std::size_t peak_kib() {
    std::ifstream status("/proc/self/status");
    for (std::string word; status >> word;) {
        if (word != "VmHWM:") continue;
        std::size_t kib = 0;
        status >> kib;
        return kib;
    }
    return 0;
}

} // namespace

int main(int argc, char** argv) {
    if (argc != 2) return 1;
    const std::filesystem::path path = argv[1];
    std::cout << outcome_of([&] {
        return std::to_string(spa::import::read_model(path).model.triangles.size()) + " triangles";
    }) << '\n';
    std::cout << outcome_of([&] {
        return std::to_string(spa::import::read_scene(path).scene.nodes.size()) + " nodes";
    }) << '\n';
    std::cout << (sanitized ? 0 : peak_kib()) << '\n';
}
