// SPDX-License-Identifier: Apache-2.0
#include "interrupt.h"
#include "output.h"
#include "progress.h"
#include "render_pictures.h"
#include "render_plan_report.h"
#include "render_report.h"
#include "text.h"
#include "verb.h"

#include <nlohmann/json.hpp>

#include <chrono>
#include <iostream>
#include <memory>
#include <optional>
#include <utility>

namespace spa::tools {

namespace {

class Stopwatch {
public:
    [[nodiscard]] double seconds() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    }

private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

// What is written, in the order of the report.
struct Output {
    std::filesystem::path path;
    std::vector<std::byte> bytes;
};

std::vector<std::filesystem::path> output_paths(const RenderArguments& arguments) {
    std::vector<std::filesystem::path> paths{arguments.output};
    if (arguments.aovs && !arguments.writes_exr())
        for (const char* const name : aov_names) paths.push_back(beside(arguments.output, name));
    if (!arguments.difference.empty()) paths.push_back(arguments.difference);
    if (!arguments.plan_sheet.empty()) paths.push_back(arguments.plan_sheet);
    return paths;
}

void check_outputs(const RenderArguments& arguments, const import::Report& source) {
    std::vector<std::filesystem::path> inputs{arguments.scene};
    for (const MapArgument& map : arguments.maps) inputs.emplace_back(map.file);
    if (!arguments.plan.empty()) inputs.push_back(arguments.plan);
    for (const import::SourceFile& file : source.files)
        inputs.push_back(arguments.scene.parent_path() / file.name);
    if (!arguments.compare.empty()) inputs.push_back(arguments.compare);
    const std::vector<std::filesystem::path> outputs = output_paths(arguments);
    for (std::size_t i = 0; i < outputs.size(); ++i) {
        check_output_file(outputs[i], inputs);
        for (std::size_t j = 0; j < i; ++j)
            if (outputs[i].lexically_normal() == outputs[j].lexically_normal())
                throw Error(ExitCode::usage, outputs[i].string() + ": would be written twice");
    }
}

render::GpuOptions gpu_options(const RenderArguments& arguments) {
    render::GpuOptions options;
    options.device = arguments.device;
    options.tracing.pipelines = arguments.settings.backend == render::Backend::pipeline;
    options.tracing.queries = arguments.settings.backend == render::Backend::query;
    return options;
}

void list_devices(const RenderArguments& arguments) {
    const std::vector<render::DeviceEntry> devices = render::list_devices(gpu_options(arguments).tracing);
    print(arguments.format == ReportFormat::json ? json_text(devices_json(devices)) : devices_text(devices));
}

spa::import::SceneResult read_scene(const RenderArguments& arguments) {
    const SlowStep step("reading " + arguments.scene.filename().string(), arguments.quiet);
    return spa::import::read_scene(arguments.scene, {.follow_links = arguments.follow_links},
                                   {.rig = arguments.is_posed()});
}

void note(const std::string& text) { std::cerr << "spa: note: " << text << '\n'; }

// What the scene lacks to be seen.
render::Settings complete_scene(Scene& scene, const RenderArguments& arguments,
                                const std::optional<std::size_t>& animation,
                                const std::vector<double>& times) {
    render::Settings settings = arguments.settings;
    settings.camera = scene.cameras.empty() && !arguments.camera && !times.empty()
                          ? framing_camera(scene, *animation, times, double(settings.width) / settings.height)
                          : choose_camera(scene, arguments);
    if (scene.cameras.empty())
        note(arguments.scene.string() + ": has no camera; it is shown as a whole, from the front");
    if (scene.lights.empty()) {
        scene.lights.push_back(default_sun(settings.camera));
        if (arguments.frames != 0) scene.lights.push_back(default_fill(settings.camera));
        note(arguments.scene.string() + ": has no light; a sun shines from above the camera's left shoulder" +
             (arguments.frames != 0 ? ", and a weaker one from its right" : ""));
    }
    return settings;
}

// Poses the scene for one picture; a sheet poses it for each. Which animation it is.
std::optional<std::size_t> choose_moment(Scene& scene, const RenderArguments& arguments) {
    if (!arguments.is_posed()) return {};
    const std::size_t animation = choose_animation(scene, arguments);
    const Animation& chosen = scene.rig.animations[animation];
    if (arguments.time && *arguments.time > chosen.seconds)
        note("the animation ends after " + significant(chosen.seconds, 4) + " s: it is shown at its end");
    if (arguments.frames == 0) pose_scene(scene, animation, arguments.time.value_or(0));
    return animation;
}

std::unique_ptr<render::DeviceScene> upload(const RenderArguments& arguments, const render::Gpu& gpu,
                                            const Scene& scene, const std::vector<PlacedMap>& maps,
                                            const std::vector<std::uint32_t>& dropped) {
    const SlowStep step("building acceleration structures", arguments.quiet);
    return std::make_unique<render::DeviceScene>(gpu, scene, placements(scene, maps, dropped, arguments),
                                                 arguments.uses_replaced_triangles());
}

render::Frame render_with_progress(const RenderArguments& arguments, const std::string& what,
                                   const render::Gpu& gpu, const render::DeviceScene& scene,
                                   const render::Settings& settings, render::FrameTimes& times) {
    ProgressReport progress("rendering " + what, arguments.quiet);
    render::Frame frame = render::render(gpu, scene, settings, &times, [&progress](double share) {
        progress.update(share);
        return interrupt_signal() == 0;
    });
    InterruptGuard::check();
    return frame;
}

std::vector<AnimationFrame> render_sheet(const RenderArguments& arguments, const render::Gpu& gpu,
                                         render::DeviceScene& device_scene, Scene& scene, RenderFacts& facts,
                                         const std::vector<double>& times) {
    ProgressReport progress("rendering " + arguments.output.filename().string(), arguments.quiet);
    std::vector<AnimationFrame> frames =
        render_frames(arguments, gpu, scene, facts.maps, facts.settings, *facts.animation, times,
                      device_scene, facts.frame_times, [&progress](double share) {
                          progress.update(share);
                          return interrupt_signal() == 0;
                      });
    InterruptGuard::check();
    return frames;
}

std::vector<Output> encode(const RenderFacts& facts, const render::Frame& frame) {
    const RenderArguments& arguments = facts.arguments;
    const std::optional<ImageComparison>& comparison = facts.comparison;
    std::vector<Output> outputs;
    if (arguments.writes_exr()) {
        outputs.push_back({arguments.output, encode_frame(frame)});
    } else {
        outputs.push_back({arguments.output, encode_png(tone_map(frame.width, frame.height, beauty(frame),
                                                                 arguments.exposure))});
        if (arguments.aovs)
            for (const NamedPicture& aov : aov_pictures(frame, arguments.exposure))
                outputs.push_back({beside(arguments.output, aov.name), encode_png(aov.picture)});
    }
    if (comparison && !arguments.difference.empty()) {
        const std::string title =
            arguments.output.filename().string() + " and " + arguments.compare.filename().string();
        outputs.push_back({arguments.difference, encode_png(comparison_sheet(*comparison, title))});
    }
    if (facts.plan && !arguments.plan_sheet.empty())
        outputs.push_back({arguments.plan_sheet, encode_png(plan_sheet(*facts.plan, frame.width, frame.height,
                                                                       arguments.exposure))});
    return outputs;
}

// All of them or, unless a rename fails half way, none.
std::vector<WrittenFile> write(const std::vector<Output>& outputs) {
    std::vector<std::unique_ptr<StagedFile>> staged;
    std::vector<WrittenFile> written;
    for (const Output& output : outputs) {
        staged.push_back(std::make_unique<StagedFile>(output.path));
        staged.back()->write(output.bytes);
        written.push_back({output.path.string(), output.bytes.size()});
    }
    InterruptGuard::check();
    for (const std::unique_ptr<StagedFile>& file : staged) file->commit();
    return written;
}

void judge(const std::optional<ImageComparison>& comparison, const RenderArguments& arguments) {
    if (!comparison) return;
    const std::vector<ImageLimit> missed = comparison->missed();
    if (missed.empty()) return;
    std::string message =
        arguments.output.string() + " misses its limits against " + arguments.compare.string() + ": ";
    for (std::size_t i = 0; i < missed.size(); ++i)
        message += (i == 0 ? "" : "; ") + limit_sentence(*comparison, missed[i]);
    throw Error(ExitCode::limits, message);
}

void compare_with_plan(RenderFacts& facts, const PlacedPlan& placed, const render::Gpu& gpu,
                       const Scene& scene, const render::Frame& frame,
                       const std::optional<import::LinearPicture>& reference) {
    facts.plan.emplace(PlanFacts{placed, {}, {}, {}, {}, 0});
    PlanVariant& plan = facts.plan->plan;
    plan.times = facts.frame_times;
    plan.memory = facts.memory;
    plan.file_bytes = placed.file_bytes;
    plan.maps = placed.maps.size();
    if (facts.arguments.plan_only) return;
    compare_plan(*facts.plan, facts.arguments, gpu, scene, facts.settings, frame,
                 reference ? &*reference : nullptr,
                 [&](const std::string& what, const render::DeviceScene& on_device,
                     const render::Settings& settings, render::FrameTimes& times) {
                     return render_with_progress(facts.arguments, what, gpu, on_device, settings, times);
                 });
}

void render_scene(const RenderArguments& given) {
    if (given.list_devices) return list_devices(given);
    RenderArguments arguments = given;
    std::optional<Plan> plan;
    if (!arguments.plan.empty()) plan = read_plan(arguments.plan);
    if (plan && arguments.scene.empty()) arguments.scene = plan->scene;
    if (plan && !arguments.camera) arguments.camera = plan->camera;
    if (plan && plan->samples && !arguments.has_samples) arguments.settings.samples = *plan->samples;
    const Stopwatch all;
    check_outputs(arguments, {});
    std::optional<InterruptGuard> guard(std::in_place);
    const render::Gpu gpu(gpu_options(arguments));
    std::optional<import::LinearPicture> reference;
    if (!arguments.compare.empty())
        reference = read_reference(arguments.compare, arguments.settings, arguments.fail);

    const Stopwatch reading;
    spa::import::SceneResult source = read_scene(arguments);
    check_outputs(arguments, source.report);
    std::optional<PlacedPlan> placed;
    if (plan) placed = place_plan(source.scene, arguments, std::move(*plan));
    const std::vector<PlacedMap> own_maps =
        placed ? std::vector<PlacedMap>() : place_maps(source.scene, arguments);
    const std::vector<PlacedMap>& maps = placed ? placed->maps : own_maps;
    for (const std::string& sentence :
         placed ? plan_warnings(*placed, arguments) : misfits(source.scene, maps, arguments.is_posed()))
        std::cerr << "spa: warning: " << sentence << '\n';
    const double read_seconds = reading.seconds();
    const std::optional<std::size_t> animation = choose_moment(source.scene, arguments);
    const std::vector<double> times =
        animation ? frame_times(source.scene.rig.animations[*animation], arguments.frames)
                  : std::vector<double>{};
    const render::Settings settings = complete_scene(source.scene, arguments, animation, times);
    InterruptGuard::check();

    std::unique_ptr<render::DeviceScene> scene =
        upload(arguments, gpu, source.scene, maps, placed ? placed->dropped : std::vector<std::uint32_t>());
    InterruptGuard::check();
    RenderFacts facts{arguments, settings, source.scene, maps, gpu.entry()};
    facts.animation = animation;
    if (arguments.frames != 0) {
        facts.frames = render_sheet(arguments, gpu, *scene, source.scene, facts, times);
        facts.memory = scene->memory();
        facts.scene_times = scene->times();
        const std::string title =
            arguments.scene.filename().string() + "  " + source.scene.rig.animations[*animation].name;
        facts.files = write({{arguments.output, encode_png(frames_sheet(facts.frames, title))}});
    } else {
        const render::Frame frame = render_with_progress(arguments, arguments.output.filename().string(), gpu,
                                                         *scene, settings, facts.frame_times);
        facts.memory = scene->memory();
        facts.scene_times = scene->times();
        scene.reset(); // those that a plan is compared with take its memory
        if (placed) compare_with_plan(facts, *placed, gpu, source.scene, frame, reference);
        if (reference)
            facts.comparison = compare_with(frame, *reference, arguments.compare.string(), arguments.exposure,
                                            arguments.fail);
        facts.files = write(encode(facts, frame));
    }
    facts.read_seconds = read_seconds;
    facts.seconds = all.seconds();
    guard.reset();

    for (const std::string& warning : source.report.warnings)
        std::cerr << "spa: warning: " << warning << '\n';
    print(arguments.format == ReportFormat::json ? json_text(report_json(facts)) : report_text(facts));
    judge(facts.comparison, arguments);
}

} // namespace

Verb render_verb() {
    return {
        .name = "render",
        .summary = "render a scene with maps in place of objects",
        .description =
            "Renders a scene on a Vulkan device that traces rays, without a window, and writes one picture. "
            "Objects of the scene can be maps instead of triangles, for each kind of ray on its own: rays "
            "from the camera, shadow rays to the lights, and secondary rays, which bring the light of one "
            "diffuse bounce. As a rule the first meet triangles and the others maps, as in the paper.\n\n"
            "Materials are diffuse with base colour, lights are those of KHR_lights_punctual. A scene "
            "without a light gets a sun, one without a camera is shown as a whole; a note says so.\n\n"
            "An EXR holds linear light as 32-bit floats: the picture and, as layers, direct and indirect "
            "light, albedo, normal (in the world), depth (distance from the camera) and kind of hit (0 "
            "nothing, 1 triangle, 2 outer end of a map's interval, 3 inner end, 4 wall). A PNG holds the "
            "picture as a display shows it. The same scene, options and device give the same bytes.\n\n"
            "--time draws a moment of an animation and --frames a sheet of several: docs/animation.md.\n\n"
            "--compare sets the picture beside a reference and prints relMSE, RMSE, PSNR and SSIM, of direct "
            "and indirect light too if the reference has these layers. What the figures mean is in "
            "docs/measures.md.\n\n"
            "--plan shows a scene as 'spa plan' decided: maps where it pays, triangles elsewhere, and what "
            "is "
            "dropped is not there for rays that meet maps. The report sets the indirect light beside that of "
            "triangles alone (the same seed), and beside maps that are all of the plan's one size, which are "
            "baked in memory for it, with the time of a frame and the bytes that each kind of ray needs.",
        .examples = "$ spa render corner.glb -o corner.png\n"
                    "$ spa render corner.glb --map boot=boot.spa -o corner.exr --samples 128\n"
                    "$ spa render corner.glb -o ref.exr --reference\n"
                    "$ spa render corner.glb --map boot=boot.spa -o fan.exr --method fan \\\n"
                    "      --test-rays 10 --compare ref.exr --difference fan.png \\\n"
                    "      --fail indirect.relmse=0.01,ssim=0.98\n"
                    "$ spa render --plan room.plan.json -o room.png\n"
                    "$ spa render fox.glb --animation Run --time 0.4 -o run.png\n"
                    "$ spa render fox.glb --map fox.spa --frames 8 -o sheet.png\n"
                    "$ spa render --list-devices",
        .see_also = "spa sample, spa bake, spa plan, spa validate",
        .define = [](CLI::App& app) -> std::function<void()> {
            return [complete = define_render_arguments(app)] { render_scene(complete()); };
        },
    };
}

} // namespace spa::tools
