// SPDX-License-Identifier: Apache-2.0
#include "bake_search.h"

#include "interrupt.h"
#include "progress.h"
#include "search_report.h"

#include <utility>

namespace spa::tools {

plan::SearchResult search_with_progress(const BakeArguments& arguments, const Model& model) {
    ProgressReport progress("searching a map of " + arguments.input.filename().string(), arguments.quiet);
    plan::SearchRequest request = *arguments.settings.search;
    request.options.threads = arguments.settings.options.threads;
    try {
        plan::SearchResult result = plan::search(model, request, [&progress](double share) {
            progress.update(share);
            return interrupt_signal() == 0;
        });
        if (!result.chosen)
            throw Error(ExitCode::limits,
                        unmet_text(arguments.settings, result) + "; --best writes the nearest nonetheless");
        return result;
    } catch (const Error& error) {
        // The search knows a model, not the file that it came from.
        throw Error(error.code(), arguments.input.string() + ": " + error.what());
    }
}

} // namespace spa::tools
