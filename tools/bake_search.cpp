// SPDX-License-Identifier: Apache-2.0
#include "bake_search.h"

#include "interrupt.h"
#include "progress.h"
#include "search_report.h"

#include "../libspa/plan/search_parts.h"

#include <utility>

namespace spa::tools {

plan::SearchResult search_with_progress(const BakeArguments& arguments, const SourceAsset& source) {
    ProgressReport progress("searching a map of " + arguments.input.filename().string(), arguments.quiet);
    plan::SearchRequest request = *arguments.settings.search;
    request.options.threads = arguments.settings.options.threads;
    try {
        const bake::Progress update = [&progress](double share) {
            progress.update(share);
            return interrupt_signal() == 0;
        };
        plan::SearchResult result =
            source.partition.size() == 1
                ? plan::search(source.asset.model, request, update)
                : plan::search_parts(source.asset.model, source.partition, request, update);
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
