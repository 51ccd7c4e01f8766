// SPDX-License-Identifier: Apache-2.0
#include "batch_arguments.h"

#include "memory_budget.h"
#include "plan_file.h"

#include <CLI/App.hpp>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <thread>

namespace spa::tools {

namespace {

constexpr std::uint32_t max_jobs = 1024;
constexpr std::uint32_t max_seconds = 7 * 24 * 3600;
constexpr std::uint32_t max_shards = 1'000'000;
// What is under a bake: libraries, the allocator's first block, stacks.
constexpr std::uint64_t least_memory = std::uint64_t(256) << 20U;

// As given; what is absent is decided when all of them are known.
struct Given {
    BatchArguments arguments;
    std::string shard, memory, config;
};

void add_list(CLI::App& app, const std::string& option, const std::string& value_name,
              const std::string& description, std::vector<std::string>& list) {
    app.add_option_function<std::vector<std::string>>(
           option, [&list](const std::vector<std::string>& texts) { list = texts; }, description)
        ->type_name(value_name)
        ->type_size(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->allow_extra_args(false);
}

void define_selection(CLI::App& app, Given& given) {
    AssetQuery& query = given.arguments.query;
    CLI::Option* const inputs =
        app.add_option_function<std::vector<std::string>>(
               "IN", [&query](const std::vector<std::string>& texts) { query.inputs = texts; },
               "Folders, searched to the bottom for glTF, GLB, OBJ, PLY, STL and OFF; files; @FILE, a list "
               "of "
               "files, one a line or ended by zero bytes; - for such a list on standard input")
            ->type_name("IN...")
            ->required();
    CLI::Option* const output = add_path(app, "-o,--output", "OUT_DIR",
                                         "The folder for the maps, made if it is missing. IN/props/boot.glb "
                                         "becomes OUT_DIR/props/boot.spa; "
                                         "if there is a boot.obj too, boot.glb.spa and boot.obj.spa",
                                         query.output)
                                    ->required();
    // The parser asks for what is required after it has run this.
    add_text(app, "--from-plan", "PLAN.json",
             "Bake the objects of a scene that 'spa plan' decided to be maps, each with the settings chosen "
             "for it, instead of IN. The maps go where the plan says, below its folder or below OUT_DIR; the "
             "path there without .spa is the asset's name. Options of a bake given here overrule the plan's",
             [=, &given](const std::string& text) {
                 given.arguments.plan = text;
                 inputs->required(false);
                 output->required(false);
             });
    add_list(app, "--include", "GLOB",
             "Only assets whose path below IN matches, such as '*.obj' (at any depth), 'props/*.glb' or "
             "'heroes/**'; may be given again",
             query.include);
    add_list(app, "--exclude", "GLOB", "Not those that match; may be given again", query.exclude);
    add_text(
        app, "--shard", "I/N|auto",
        "Only the Ith of N shares of the assets, I from 1 to N (or 0 to N-1). Which share an asset is in "
        "depends "
        "on its path below IN alone. auto reads the environment of a Slurm job array or a Kubernetes indexed "
        "job (samples/cluster)",
        [&given](const std::string& text) { given.shard = text; });
    add_follow_links(app, query.follow_links);
}

void define_running(CLI::App& app, Given& given) {
    BatchArguments& arguments = given.arguments;
    add_text(app, "--config", "FILE",
             "Options of a bake for all assets and by pattern, as JSON: {\"options\": {\"size\": 128}, "
             "\"patterns\": "
             "[{\"match\": \"heroes/**\", \"options\": {\"size\": 512}}]}. The last pattern that matches "
             "wins over "
             "those before, the command line over the file",
             [&given](const std::string& text) { given.config = text; });
    arguments.jobs = std::max(1U, std::thread::hardware_concurrency());
    add_text(app, "--jobs", "N", "Assets to bake at once", [&arguments](const std::string& text) {
        arguments.jobs = parse_number("--jobs", text, 1, max_jobs);
    })->default_str("one a core");
    add_threads(app, "Threads of each bake; 0 means one a core", arguments.threads);
    add_text(app, "--memory", "SIZE",
             "Memory for all bakes together, such as 8G or 512M: so many run at once as are estimated to "
             "fit. A bake "
             "that needs more than its share is tried again alone, and fails if it needs more than all",
             [&given](const std::string& text) { given.memory = text; })
        ->default_str("three quarters of what is free");
    add_text(app, "--timeout", "SECONDS", "A bake that takes longer is stopped and counts as failed",
             [&arguments](const std::string& text) {
                 arguments.timeout = std::chrono::seconds(parse_number("--timeout", text, 1, max_seconds));
             });
    app.add_flag("--keep-going", arguments.keep_going,
                 "Go on even where no output can be written: disk full, folder read-only");
    app.add_flag("--force", arguments.force, "Bake what is up to date, too");
    app.add_flag("--dry-run", arguments.dry_run, "Say what would be baked and why; write no map");
}

void define_reporting(CLI::App& app, Given& given) {
    BatchArguments& arguments = given.arguments;
    app.add_option_function<std::vector<std::string>>(
           "--report",
           [&arguments](const std::vector<std::string>& texts) {
               for (const std::string& text : texts) {
                   if (!text.ends_with(".json") && !text.ends_with(".html"))
                       throw Error(ExitCode::usage,
                                   "--report: '" + text + "' ends neither with .json nor with .html");
                   arguments.reports.emplace_back(text);
               }
           },
           "Write what became of each asset into this file: JSON (formats/schemas/batch.schema.json), or one "
           "page for a browser with pictures, sortable, failures first; may be given again")
        ->type_name("OUT.json|OUT.html")
        ->type_size(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->allow_extra_args(false);
    add_report_format(app, arguments.format);
    app.add_flag("-q,--quiet", arguments.quiet, "No progress on standard error");
}

std::uint32_t number_in(const char* variable, const char* text, std::uint32_t lowest) {
    return parse_number(std::string("--shard auto: ") + variable, text, lowest, max_shards);
}

Shard shard_of_environment(const std::function<const char*(const char*)>& variable) {
    const char* count = variable("SPA_SHARD_COUNT");
    if (const char* index = variable("SPA_SHARD_INDEX"); index != nullptr && count != nullptr)
        return {number_in("SPA_SHARD_INDEX", index, 0), number_in("SPA_SHARD_COUNT", count, 1)};
    if (const char* task = variable("SLURM_ARRAY_TASK_ID"); task != nullptr) {
        const char* first = variable("SLURM_ARRAY_TASK_MIN");
        const char* step = variable("SLURM_ARRAY_TASK_STEP");
        const char* tasks = variable("SLURM_ARRAY_TASK_COUNT");
        if (first == nullptr || tasks == nullptr)
            throw Error(ExitCode::usage,
                        "--shard auto: SLURM_ARRAY_TASK_ID is set, but SLURM_ARRAY_TASK_MIN and "
                        "SLURM_ARRAY_TASK_COUNT are not; give I/N");
        const std::uint32_t id = number_in("SLURM_ARRAY_TASK_ID", task, 0);
        const std::uint32_t min = number_in("SLURM_ARRAY_TASK_MIN", first, 0);
        const std::uint32_t by = step == nullptr ? 1 : number_in("SLURM_ARRAY_TASK_STEP", step, 1);
        if (id < min || (id - min) % by != 0)
            throw Error(ExitCode::usage,
                        "--shard auto: SLURM_ARRAY_TASK_ID, _MIN and _STEP do not fit together");
        return {(id - min) / by + 1, number_in("SLURM_ARRAY_TASK_COUNT", tasks, 1)};
    }
    if (const char* index = variable("JOB_COMPLETION_INDEX"); index != nullptr) {
        if (count == nullptr)
            throw Error(ExitCode::usage,
                        "--shard auto: JOB_COMPLETION_INDEX is set, but Kubernetes does not tell the "
                        "number of completions; set SPA_SHARD_COUNT to it");
        return {number_in("JOB_COMPLETION_INDEX", index, 0) + 1, number_in("SPA_SHARD_COUNT", count, 1)};
    }
    throw Error(ExitCode::usage, "--shard auto: none of SPA_SHARD_INDEX, SLURM_ARRAY_TASK_ID and "
                                 "JOB_COMPLETION_INDEX is set; give I/N");
}

BatchArguments complete(const Given& given, const CLI::App& app) {
    BatchArguments arguments = given.arguments;
    if (!given.shard.empty())
        arguments.query.shard =
            parse_shard(given.shard, [](const char* variable) { return std::getenv(variable); });
    arguments.memory_bytes =
        given.memory.empty() ? default_memory_budget() : parse_byte_count("--memory", given.memory);
    if (!given.memory.empty() && arguments.memory_bytes < least_memory)
        throw Error(ExitCode::usage,
                    "--memory: '" + given.memory + "' is less than any bake needs; give 256M or more");
    arguments.command_line = given_settings(app);
    static_cast<void>(parse_settings(arguments.command_line));
    if (!given.config.empty()) arguments.config = read_batch_config(given.config);
    if (arguments.plan.empty()) return arguments;
    if (arguments.query.output.empty()) arguments.query.output = folder_of_plan(arguments.plan);
    if (!arguments.query.inputs.empty())
        throw Error(ExitCode::usage, "--from-plan: '" + arguments.query.inputs.front() +
                                         "' is not baked with it; the scene is that of the plan");
    if (!given.config.empty())
        throw Error(ExitCode::usage, "--from-plan: the plan has the options; leave --config out");
    return arguments;
}

} // namespace

Shard parse_shard(const std::string& text, const std::function<const char*(const char*)>& variable) {
    Shard shard;
    if (text == "auto") {
        shard = shard_of_environment(variable);
    } else {
        const std::size_t slash = text.find('/');
        if (slash == std::string::npos)
            throw Error(ExitCode::usage, "--shard: '" + text + "' is neither I/N, such as 1/4, nor auto");
        shard.index = parse_number("--shard (I)", text.substr(0, slash), 0, max_shards);
        shard.count = parse_number("--shard (N)", text.substr(slash + 1), 1, max_shards);
    }
    if (shard.index > shard.count)
        throw Error(ExitCode::usage, "--shard: " + std::to_string(shard.index) + " is more than " +
                                         std::to_string(shard.count) + ", the number of shares");
    if (shard.index == 0) shard.index = shard.count;
    return shard;
}

std::function<BatchArguments()> define_batch_arguments(CLI::App& app) {
    const auto given = std::make_shared<Given>();
    define_selection(app, *given);
    define_running(app, *given);
    define_reporting(app, *given);
    // Only to be in the parser and the manual; what was given is collected by name, to be merged with the
    // file's.
    const std::function<BakeSettings()> settings = define_bake_settings(app);
    return [given, settings, &app] { return complete(*given, app); };
}

} // namespace spa::tools
