// SPDX-License-Identifier: Apache-2.0
// write_samples FOLDER: every sample at its lowest, default and a high level, and every scene, for
// gltf-validator.
#include "../../samples/scenes.h"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <set>
#include <string>

int main(int argc, char** argv) {
    if (argc != 2) return 1;
    try {
        const std::filesystem::path folder = argv[1];
        std::filesystem::remove_all(folder);
        std::filesystem::create_directories(folder);
        for (const spa::samples::Sample& sample : spa::samples::list()) {
            for (const int level : std::set{0, sample.default_level, 5}) {
                const std::string file = std::string(sample.name) + "_" + std::to_string(level) + ".glb";
                spa::samples::write_glb(spa::samples::make_sample(sample.name, level), folder / file);
            }
        }
        for (const spa::samples::Sample& scene : spa::samples::list_scenes())
            spa::samples::write_glb(spa::samples::make_scene(scene.name, 1),
                                    folder / (std::string(scene.name) + ".glb"));
    } catch (const std::exception& error) {
        std::fprintf(stderr, "write_samples: %s\n", error.what());
        return 1;
    }
    return 0;
}
