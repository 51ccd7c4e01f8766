// SPDX-License-Identifier: Apache-2.0
#include "render.h"

#include "batches.h"
#include "clock.h"
#include "kernel.h"
#include "upload.h"

#include "../core/error.h"
#include "../vulkan/build.h"
#include "../vulkan/submit.h"

#include <cmath>
#include <string>

namespace spa::render {
namespace {

void check_settings(const Settings& settings, const DeviceScene::State& scene) {
    if (settings.width == 0 || settings.height == 0 || settings.antialias == 0)
        throw Error(ExitCode::usage, "a picture has at least one pixel, and a pixel one primary ray");
    if (std::uint64_t(settings.width) * settings.height > max_pixels)
        throw Error(ExitCode::usage, "a picture has at most 2^26 pixels");
    const double fov = settings.camera.vertical_fov;
    if (!(fov > 0 && fov < 3.14159265358979))
        throw Error(ExitCode::usage,
                    "the camera's vertical field of view has to lie between 0 and pi radians");
    const bool triangles = settings.primary == Geometry::triangles ||
                           settings.shadow == Geometry::triangles ||
                           settings.secondary == Geometry::triangles;
    if (triangles && !scene.has_replaced)
        throw Error(ExitCode::usage,
                    "rays are to hit the triangles of objects that maps replace, which this scene "
                    "was loaded without");
}

data::float3 convert(Vec3d v) { return {float(v.x), float(v.y), float(v.z)}; }

std::uint32_t mask_of(Geometry geometry) {
    return SPA_MASK_STATIC | (geometry == Geometry::maps ? SPA_MASK_MAPS : SPA_MASK_REPLACED);
}

data::RenderGlobals make_globals(const DeviceScene::State& scene, const Settings& settings) {
    data::RenderGlobals globals = scene.globals;
    const Affine& camera = settings.camera.to_world;
    const double up = std::tan(settings.camera.vertical_fov / 2);
    const double right = up * settings.width / settings.height;
    globals.eye = convert(camera.translation);
    globals.right = convert(transform_vector(camera, {right, 0, 0}));
    globals.up = convert(transform_vector(camera, {0, up, 0}));
    globals.forward = convert(transform_vector(camera, {0, 0, -1}));
    globals.width = settings.width;
    globals.height = settings.height;
    globals.seed = settings.seed;
    globals.antialias = settings.antialias;
    globals.primary_mask = mask_of(settings.primary);
    globals.shadow_mask = mask_of(settings.shadow);
    globals.secondary_mask = mask_of(settings.secondary);
    return globals;
}

// The renderer of one frame.
class Renderer {
public:
    Renderer(const Gpu& gpu, const DeviceScene::State& scene, const Settings& settings)
        : gpu_(gpu), settings_(settings) {
        const std::size_t pixels = std::size_t(settings.width) * settings.height;
        surfaces_ = vulkan::Buffer(gpu.device(), pixels * sizeof(data::RenderSurface),
                                   VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, vulkan::MemoryUse::device);
        pixels_ = vulkan::Buffer(gpu.device(), pixels * sizeof(data::RenderPixel),
                                 VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                                 vulkan::MemoryUse::device);
        data::RenderGlobals globals = make_globals(scene, settings);
        globals.surfaces = surfaces_.address();
        globals.pixels = pixels_.address();
        globals_ = upload(gpu, std::vector<data::RenderGlobals>{globals});
        times_.compile = seconds_of([&] {
            kernel_ = &kernel_for(gpu, settings.backend, settings.tracing);
            kernel_->use(scene);
            // Some drivers compile when a shader is first used: no rows.
            submit({});
        });
    }

    // False if `progress` said so.
    bool run(const std::function<bool(double)>& progress) {
        Batches batches(settings_.width, settings_.height, settings_.antialias, settings_.samples,
                        settings_.batch_seconds);
        while (const auto batch = batches.next()) {
            const double seconds = seconds_of([&] { submit(*batch); });
            (batch->pass == Pass::primary ? times_.primary : times_.secondary) += seconds;
            batches.took(seconds);
            if (progress && !progress(batches.share_done())) return false;
        }
        return true;
    }

    Frame frame();
    [[nodiscard]] const FrameTimes& times() const { return times_; }

private:
    void submit(const Batch& batch) {
        data::RenderBatch push{};
        push.globals = globals_.address();
        push.first_row = batch.first_row;
        push.end_row = batch.end_row;
        push.first_sample = batch.first_sample;
        push.end_sample = batch.end_sample;
        push.primary_ray = batch.primary_ray;
        push.pass = std::uint32_t(batch.pass);
        vulkan::submit_and_wait(
            gpu_.device(), gpu_.queue(), gpu_.queue_family(), [&](VkCommandBuffer commands) {
                kernel_->record(commands, push, settings_.width);
                vulkan::memory_barrier(gpu_.device().call(), commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT,
                                       VK_ACCESS_SHADER_WRITE_BIT,
                                       VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT);
            });
    }

    const Gpu& gpu_;
    const Settings& settings_;
    vulkan::Buffer surfaces_, pixels_, globals_;
    Kernel* kernel_ = nullptr;
    FrameTimes times_;
};

Vec3f scaled(const data::float3& v, float scale) { return {v.x * scale, v.y * scale, v.z * scale}; }

Frame Renderer::frame() {
    const std::size_t count = std::size_t(settings_.width) * settings_.height;
    std::vector<data::RenderPixel> pixels(count);
    download_bytes(gpu_, pixels_, std::as_writable_bytes(std::span(pixels)));
    Frame frame;
    frame.width = settings_.width;
    frame.height = settings_.height;
    const float of_ray = 1.0F / float(settings_.antialias);
    const float of_sample = settings_.samples == 0 ? 0.0F : of_ray / float(settings_.samples);
    for (const data::RenderPixel& pixel : pixels) {
        frame.direct.push_back(scaled(pixel.direct, of_ray));
        frame.indirect.push_back(scaled(pixel.indirect, of_sample));
        frame.normal.push_back(normalize(scaled(pixel.normal, of_ray)));
        frame.albedo.push_back(scaled(pixel.albedo, of_ray));
        frame.depth.push_back(pixel.depth < 0 ? std::numeric_limits<float>::infinity() : pixel.depth);
        frame.kind.push_back(std::uint8_t(pixel.kind));
        times_.secondary_rays += pixel.secondary_rays;
        times_.shadow_rays += pixel.shadow_rays;
    }
    times_.primary_rays = std::uint64_t(count) * settings_.antialias;
    return frame;
}

} // namespace

Frame render(const Gpu& gpu, const DeviceScene& scene, const Settings& settings, FrameTimes* times,
             const std::function<bool(double)>& progress) {
    check_settings(settings, scene.state());
    Renderer renderer(gpu, scene.state(), settings);
    Frame frame;
    if (renderer.run(progress)) frame = renderer.frame();
    if (times != nullptr) *times = renderer.times();
    return frame;
}

} // namespace spa::render
