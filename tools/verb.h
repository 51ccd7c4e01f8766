// SPDX-License-Identifier: Apache-2.0
// The verbs of the `spa` command. One table (verbs.cpp) is what dispatch and help read; a verb is one file
// that defines one function of those declared in verbs.cpp.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>

namespace CLI {
class App;
}

namespace spa::tools {

struct Verb {
    const char* name;
    const char* summary;     // one line, for the list of verbs
    const char* description; // of the manual page: paragraphs divided by empty lines
    const char* examples;    // of the manual page: lines that begin with "$ " are commands
    const char* see_also;
    // Adds the verb's options to the parser and returns what runs once they are parsed. What it returns
    // writes results to stdout, diagnostics to stderr, and throws Error or bake::Cancelled.
    std::function<void()> (*define)(CLI::App&);
};

// In the order in which help lists them.
std::span<const Verb> verbs();
// nullptr if there is no such verb.
const Verb* find_verb(std::string_view name);

// The manual page of one verb, and that of the command itself. Width 80.
std::string manual_page(const Verb& verb);
std::string manual_page();

} // namespace spa::tools
