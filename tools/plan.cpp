// SPDX-License-Identifier: Apache-2.0
#include "interrupt.h"
#include "output.h"
#include "plan_page.h"
#include "plan_report.h"
#include "progress.h"
#include "render_input.h"
#include "verb.h"

#include <nlohmann/json.hpp>

#include <iostream>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace spa::tools {

namespace {

void check_outputs(const PlanArguments& arguments, const import::Report& source) {
    std::vector<std::filesystem::path> inputs{arguments.scene};
    for (const import::SourceFile& file : source.files)
        inputs.push_back(arguments.scene.parent_path() / file.name);
    check_output_file(arguments.output, inputs);
    if (arguments.html.empty()) return;
    check_output_file(arguments.html, inputs);
    if (arguments.html.lexically_normal() == arguments.output.lexically_normal())
        throw Error(ExitCode::usage, arguments.html.string() + ": would be written twice");
}

void note(const std::string& text) { std::cerr << "spa: note: " << text << '\n'; }

std::vector<Camera> choose_cameras(const Scene& scene, const PlanArguments& arguments) {
    const plan::PathOptions& picture = arguments.options.paths;
    const double aspect = double(picture.width) / picture.height;
    if (arguments.views) return surrounding_cameras(scene.model, aspect, *arguments.views);
    if (arguments.camera) return {find_camera(scene, arguments.scene, *arguments.camera)};
    if (!scene.cameras.empty()) return scene.cameras;
    note(arguments.scene.string() + ": has no camera; it is planned for one that shows it as a whole, from "
                                    "the front");
    return {framing_camera(scene.model, aspect)};
}

void write(const std::filesystem::path& path, const std::string& text) {
    StagedFile file(path);
    file.write(std::as_bytes(std::span(text)));
    InterruptGuard::check();
    file.commit();
}

void judge(const PlanArguments& arguments, const plan::ScenePlan& plan) {
    if (!plan.meets_error)
        throw Error(ExitCode::limits,
                    arguments.output.string() +
                        ": the plan misses --target-image-error, because --budget-bytes stops it; raise "
                        "one of them");
    if (!plan.meets_budget)
        throw Error(ExitCode::limits, arguments.output.string() +
                                          ": the plan takes more than --budget-bytes even with the smallest "
                                          "maps; raise it, or raise --drop-below");
}

void plan_file(const PlanArguments& arguments) {
    check_outputs(arguments, {});
    std::optional<InterruptGuard> guard(std::in_place);
    spa::import::SceneResult source = [&] {
        const SlowStep step("reading " + arguments.scene.filename().string(), arguments.quiet);
        return spa::import::read_scene(arguments.scene, {.follow_links = arguments.follow_links});
    }();
    check_outputs(arguments, source.report);
    const std::vector<Camera> cameras = choose_cameras(source.scene, arguments);
    if (source.scene.lights.empty()) {
        source.scene.lights.push_back(default_sun(cameras.front()));
        note(arguments.scene.string() + ": has no light; a sun shines from above the camera's left shoulder");
    }
    plan::ScenePlan plan;
    {
        ProgressReport progress("planning " + arguments.scene.filename().string(), arguments.quiet);
        plan = plan::plan_scene(source.scene, cameras, arguments.options, [&progress](double share) {
            progress.update(share);
            return interrupt_signal() == 0;
        });
    }
    const ScenePlanFacts facts{arguments, source.report, source.scene.model.triangles.size(), plan};
    const nlohmann::ordered_json json = scene_plan_json(facts);
    if (!arguments.html.empty()) write(arguments.html, plan_page(json));
    write(arguments.output, json_text(json));
    guard.reset();
    for (const std::string& warning : source.report.warnings)
        std::cerr << "spa: warning: " << warning << '\n';
    print(arguments.format == ReportFormat::json ? json_text(plan_report_json(facts))
                                                 : plan_report_text(facts));
    judge(arguments, plan);
}

} // namespace

Verb plan_verb() {
    return {
        .name = "plan",
        .summary = "decide which objects of a scene are worth which maps",
        .description =
            "Decides for each object of a scene, as the indirect light of its pictures needs it: a map and "
            "of "
            "which size, its triangles, or nothing at all. An object is a node that draws something, with "
            "all "
            "below it; nodes that draw the same mesh share a map.\n\n"
            "A picture's pixels are sampled, with the diffuse rays that 'spa render' sends from them. Small "
            "maps of each object take its place, one object at a time, and what that changes in the picture "
            "is the object's share of the image error: relMSE of the indirect light, as 'spa render "
            "--compare' prints it. What larger maps would do follows by a law through these. Then bytes "
            "are spent where they save most.\n\n"
            "'spa batch --from-plan' bakes the maps of a plan, 'spa render --plan' renders with them. What "
            "is "
            "decided how, and how far it held, is in docs/planning.md.",
        .examples = "$ spa sample room -o room.glb\n"
                    "$ spa plan room.glb -o room.json\n"
                    "$ spa plan room.glb -o room.json --views 4 --html room.html\n"
                    "$ spa plan room.glb -o room.json --budget-bytes 2000000",
        .see_also = "spa batch, spa render, spa bake",
        .define = [](CLI::App& app) -> std::function<void()> {
            return [complete = define_plan_arguments(app)] { plan_file(complete()); };
        },
    };
}

} // namespace spa::tools
