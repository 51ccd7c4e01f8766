// SPDX-License-Identifier: Apache-2.0
#include "bake_arguments.h"

#include <CLI/App.hpp>

#include <memory>

namespace spa::tools {

std::function<BakeArguments()> define_bake_arguments(CLI::App& app) {
    const auto arguments = std::make_shared<BakeArguments>();
    const auto threads = std::make_shared<unsigned>(0);
    add_path(app, "IN", "IN", "The asset: glTF, GLB, OBJ, PLY, STL or OFF", arguments->input)->required();
    add_path(app, "-o,--output", "OUT.spa", "The file to write", arguments->output)->required();
    add_text(
        app, "--node", "NAME|INDEX",
        "Bake only what this node of the asset and the nodes below it draw, in the node's own space: the "
        "map that 'spa render --map NAME=OUT.spa' puts in its place. A whole number is the node's index, "
        "anything else its name",
        [arguments](const std::string& text) { arguments->node = text; });
    const std::function<BakeSettings()> settings = define_bake_settings(app);
    add_threads(app, "Threads to use; 0 means one a core", *threads);
    add_follow_links(app, arguments->follow_links);
    add_report_format(app, arguments->format);
    app.add_flag("-q,--quiet", arguments->quiet, "No progress on standard error");
    return [arguments, settings, threads] {
        if (arguments->input == "-")
            throw Error(ExitCode::usage,
                        "an asset is not read from standard input, because it may refer to files "
                        "beside it; name a file");
        arguments->settings = settings();
        arguments->settings.options.threads = *threads;
        return *arguments;
    };
}

} // namespace spa::tools
