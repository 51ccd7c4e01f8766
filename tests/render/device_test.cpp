// SPDX-License-Identifier: Apache-2.0
#include "render_test.h"

#include "../../libspa/render/device_list.h"

#include <functional>

namespace spa::test {
namespace {

const std::vector<render::DeviceEntry> some_devices{
    {"Old Card 1", "a driver", "VK_KHR_acceleration_structure", false},
    {"Software", "another", "", true},
    {"New Card 2", "a driver", "", false},
};

ExitCode code_of(const std::function<void()>& work, std::string& message) {
    try {
        work();
    } catch (const Error& error) {
        message = error.what();
        return error.code();
    }
    return ExitCode::ok;
}

TEST(ChooseDevice, TakesHardwareThatTracesRays) {
    EXPECT_EQ(render::choose_device(some_devices, ""), 2U);
    EXPECT_EQ(render::choose_device({some_devices[0], some_devices[1]}, ""), 1U);
}

TEST(ChooseDevice, TakesAnIndexOrAPartOfAName) {
    EXPECT_EQ(render::choose_device(some_devices, "1"), 1U);
    EXPECT_EQ(render::choose_device(some_devices, "software"), 1U);
    EXPECT_EQ(render::choose_device(some_devices, "NEW"), 2U);
    EXPECT_EQ(render::choose_device(some_devices, "card"), 2U); // the first that suits
}

TEST(ChooseDevice, SaysWhatIsWrong) {
    std::string message;
    EXPECT_EQ(code_of([] { render::choose_device(some_devices, "voodoo"); }, message), ExitCode::usage);
    EXPECT_NE(message.find("voodoo"), std::string::npos);
    EXPECT_NE(message.find("New Card 2"), std::string::npos);
    EXPECT_EQ(code_of([] { render::choose_device(some_devices, "7"); }, message), ExitCode::usage);
    EXPECT_EQ(code_of([] { render::choose_device(some_devices, "old"); }, message), ExitCode::unsupported);
    EXPECT_NE(message.find("VK_KHR_acceleration_structure"), std::string::npos);
    EXPECT_EQ(code_of([] { render::choose_device({some_devices[0]}, ""); }, message), ExitCode::unsupported);
    EXPECT_NE(message.find("Old Card 1"), std::string::npos);
    EXPECT_NE(message.find("VK_KHR_acceleration_structure"), std::string::npos);
    EXPECT_EQ(code_of([] { render::choose_device({}, ""); }, message), ExitCode::unsupported);
}

class Devices : public RenderTest {};

TEST_F(Devices, AreListed) {
    bool found = false;
    for (const render::DeviceEntry& entry : render::list_devices({true, has_queries})) {
        EXPECT_FALSE(entry.name.empty());
        found = found || (entry.name == gpu->entry().name && entry.missing.empty());
    }
    EXPECT_TRUE(found);
}

TEST_F(Devices, NeedNotDoBoth) {
    if (!has_queries) GTEST_SKIP() << "without ray queries there is one way alone";
    std::string message;
    render::Settings settings;
    settings.width = settings.height = 8;
    settings.camera.vertical_fov = 1;
    Scene scene;
    scene.model.materials.emplace_back();
    for (const bool queries : {true, false}) {
        render::GpuOptions options;
        options.device = gpu->entry().name;
        options.tracing = {!queries, queries};
        const render::Gpu one(options);
        const render::DeviceScene loaded(one, scene, {}, false);
        settings.backend = queries ? render::Backend::query : render::Backend::pipeline;
        EXPECT_EQ(render::render(one, loaded, settings).direct.size(), 64U);
        settings.backend = queries ? render::Backend::pipeline : render::Backend::query;
        EXPECT_EQ(code_of([&] { render::render(one, loaded, settings); }, message), ExitCode::unsupported);
    }
}

TEST_F(Devices, AreToldWhatMakesNoSense) {
    std::string message;
    Scene scene;
    scene.model.materials.emplace_back();
    const render::DeviceScene loaded(*gpu, scene, {}, false);
    render::Settings settings; // whose camera has no field of view
    EXPECT_EQ(code_of([&] { render::render(*gpu, loaded, settings); }, message), ExitCode::usage);
    settings.camera.vertical_fov = 1;
    settings.width = 0;
    EXPECT_EQ(code_of([&] { render::render(*gpu, loaded, settings); }, message), ExitCode::usage);
    settings.width = settings.height = 1U << 14U;
    EXPECT_EQ(code_of([&] { render::render(*gpu, loaded, settings); }, message), ExitCode::usage);
}

} // namespace
} // namespace spa::test
