// SPDX-License-Identifier: Apache-2.0
// Every malformed asset as a model and as a scene: a valid one or an error that names the file. CI runs this
// under AddressSanitizer and UndefinedBehaviorSanitizer. What is said of each is in the tests of its format.
#include "../../libspa/core/error.h"
#include "../import_gltf/scene_builder.h"

#include <set>

#include <gtest/gtest.h>

namespace spa::test {
namespace {

// Whether the function reads something; it may only throw what import.h says.
template <class Read>
bool reads(const std::filesystem::path& path, const Read& read) {
    try {
        expect_valid(read(path));
        return true;
    } catch (const Error& error) {
        EXPECT_TRUE(error.code() == ExitCode::invalid_data || error.code() == ExitCode::unsupported ||
                    error.code() == ExitCode::input_output)
            << error.what();
        EXPECT_TRUE(std::string_view(error.what()).starts_with(path.string())) << error.what();
        return false;
    }
}

TEST(MalformedAssets, AsModelsAndAsScenes) {
    if (assets().empty()) GTEST_SKIP() << "no assets: set SPA_ASSETS to their folder";
    const std::set<std::string> extensions{".gltf", ".glb", ".obj", ".ply", ".stl", ".STL", ".off"};
    std::size_t count = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(assets() / "malformed")) {
        if (extensions.count(entry.path().extension().string()) == 0) continue;
        SCOPED_TRACE(entry.path());
        ++count;
        const bool model = reads(entry.path(), [](const auto& path) { return import::read_model(path); });
        const bool scene = reads(entry.path(), [](const auto& path) { return import::read_scene(path); });
        // A scene can be wrong in its cameras and lights too.
        EXPECT_TRUE(model || !scene);
    }
    EXPECT_GE(count, 90U);
}

} // namespace
} // namespace spa::test
