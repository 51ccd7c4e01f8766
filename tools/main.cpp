// SPDX-License-Identifier: Apache-2.0
#include "failure.h"
#include "interrupt.h"
#include "near_names.h"
#include "output.h"
#include "verb.h"

#include "../libspa/bake/crossings.h"
#include "../libspa/core/error.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <csignal>
#include <iostream>
#include <string>
#include <vector>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace spa::tools {

namespace {

int run_verb(const Verb& verb, const std::vector<std::string>& arguments) {
    CLI::App app;
    app.allow_windows_style_options(false);
    app.set_help_flag("-h,--help", "Show this page");
    const std::function<void()> run = verb.define(app);
    try {
        // CLI11 takes them last first.
        app.parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));
    } catch (const CLI::CallForHelp&) {
        print(manual_page(verb));
        return int(ExitCode::ok);
    } catch (const CLI::ParseError& error) {
        throw Error(ExitCode::usage, error.what());
    }
    run();
    return int(ExitCode::ok);
}

Error unknown_verb(const std::string& given) {
    std::vector<std::string> names;
    for (const Verb& verb : verbs()) names.emplace_back(verb.name);
    return {ExitCode::usage, "there is no verb '" + given + "'" + did_you_mean(given, names)};
}

// hint: what to read about a usage error, once it is known which verb was meant.
int dispatch(const std::vector<std::string>& arguments, std::string& hint) {
    hint = "spa help";
    if (arguments.empty()) {
        std::cerr << manual_page();
        return int(ExitCode::usage);
    }
    const std::string& first = arguments.front();
    if (first == "--version") {
        print("spa " SPA_VERSION "\n");
        return int(ExitCode::ok);
    }
    if (first == "--help" || first == "-h") {
        print(manual_page());
        return int(ExitCode::ok);
    }
    const Verb* verb = find_verb(first);
    if (verb == nullptr) throw unknown_verb(first);
    hint = "spa help " + first;
    return run_verb(*verb, {arguments.begin() + 1, arguments.end()});
}

// The caller (a shell, make) is to see the signal, not a code that looks like a failure.
int end_by_signal() {
    const int number = interrupt_signal();
    if (number != 0) {
        static_cast<void>(std::signal(number, SIG_DFL));
        static_cast<void>(std::raise(number));
    }
    return 130;
}

int run(const std::vector<std::string>& arguments) {
    std::string hint;
    try {
        return dispatch(arguments, hint);
    } catch (const bake::Cancelled&) {
        std::cerr << "spa: interrupted; nothing was written\n";
        return end_by_signal();
    } catch (const Interrupted& interrupted) {
        std::cerr << "spa: " << interrupted.what() << '\n';
        return end_by_signal();
    } catch (...) {
        const Failure failure = current_failure();
        std::cerr << "spa: " << failure.message << '\n';
        if (failure.code == ExitCode::usage) std::cerr << "spa: see '" << hint << "'\n";
        return int(failure.code);
    }
}

} // namespace

} // namespace spa::tools

int main(int argc, char** argv) {
#ifdef __GLIBC__
    // A bake takes and frees arrays of many megabytes. Left alone, malloc gives each back to the kernel, and
    // touching the pages of the next one costs more than the work on them.
    mallopt(M_MMAP_THRESHOLD, 1 << 30);
    mallopt(M_TRIM_THRESHOLD, 1 << 30);
    mallopt(M_TOP_PAD, 64 << 20);
#endif
    try {
        return spa::tools::run({argv + std::min(argc, 1), argv + argc});
    } catch (...) {
        return int(spa::ExitCode::internal);
    }
}
