// SPDX-License-Identifier: Apache-2.0
#include "verb.h"

#include <algorithm>
#include <vector>

namespace spa::tools {

Verb bake_verb();
Verb batch_verb();
Verb inspect_verb();
Verb extract_verb();
Verb validate_verb();
Verb compare_verb();
#ifdef SPA_HAS_RENDER // the build has Vulkan
Verb plan_verb();
Verb render_verb();
#endif
Verb sample_verb();
Verb bench_verb();
Verb help_verb();

std::span<const Verb> verbs() {
    static const std::vector<Verb> table{bake_verb(),    batch_verb(),    inspect_verb(),
                                         extract_verb(), validate_verb(), compare_verb(),
#ifdef SPA_HAS_RENDER
                                         plan_verb(),    render_verb(),
#endif
                                         sample_verb(),  bench_verb(),    help_verb()};
    return table;
}

const Verb* find_verb(std::string_view name) {
    const auto all = verbs();
    const auto found = std::find_if(all.begin(), all.end(), [&](const Verb& v) { return v.name == name; });
    return found == all.end() ? nullptr : &*found;
}

} // namespace spa::tools
