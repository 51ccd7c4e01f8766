// SPDX-License-Identifier: Apache-2.0
#include "arguments.h"
#include "output.h"
#include "text.h"
#include "verb.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <memory>
#include <sstream>

namespace spa::tools {

namespace {

constexpr std::size_t page_width = 80;
constexpr std::size_t indent = 7; // as man(1) does

constexpr const char* about =
    "Spherical maps describe the outside (and the inside) of an object by what is seen from its centre: for "
    "every direction the distance to the surface, its colour and its normal. They are baked from a mesh "
    "once, "
    "stored in a .spa file, and traced by rays in place of the mesh.";

struct ExitStatus {
    ExitCode code;
    const char* meaning;
};
constexpr ExitStatus exit_statuses[] = {
    {ExitCode::ok, "Done."},
    {ExitCode::usage, "An unknown option, a bad value or a missing argument."},
    {ExitCode::input_output, "A file cannot be opened, read, written or renamed."},
    {ExitCode::invalid_data, "A file was read and its content is wrong."},
    {ExitCode::internal, "An internal error."},
    {ExitCode::unsupported, "Valid, but it needs something that this build or this machine lacks."},
    {ExitCode::limits, "A limit that was set is missed: a measured figure, the time of a bake."},
};

void section(std::ostream& out, const char* title) { out << '\n' << title << '\n'; }

void paragraphs(std::ostream& out, std::string_view text, std::size_t left = indent) {
    for (const std::string& line : wrap_text(text, page_width - left))
        out << (line.empty() ? "" : std::string(left, ' ')) << line << '\n';
}

// Lines as they are: commands and what they print.
void verbatim(std::ostream& out, const std::string& text) {
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);)
        out << (line.empty() ? "" : std::string(indent, ' ')) << line << '\n';
}

void exit_status(std::ostream& out) {
    section(out, "EXIT STATUS");
    for (const ExitStatus& status : exit_statuses)
        out << std::string(indent, ' ') << int(status.code) << "  " << status.meaning << '\n';
}

std::string option_heading(const CLI::Option& option) {
    std::string names = option.get_name(option.get_positional(), true);
    for (std::size_t comma = names.find(','); comma != std::string::npos; comma = names.find(',', comma + 2))
        names.replace(comma, 1, ", ");
    const std::string value = option.get_type_name();
    return option.get_positional() || value.empty() ? names : names + " " + value;
}

// The verb and what it cannot do without.
std::string synopsis(const Verb& verb, const CLI::App& app) {
    std::string line = std::string("spa ") + verb.name;
    bool optional = false;
    for (const CLI::Option* option : app.get_options()) {
        if (option->get_positional())
            line +=
                option->get_required() ? " " + option->get_name(true) : " [" + option->get_name(true) + "]";
        else if (option->get_required())
            line += " " + option->get_name(false, false) + " " + option->get_type_name();
        else
            optional = true;
    }
    return optional ? line + " [option...]" : line;
}

void options(std::ostream& out, const CLI::App& app) {
    section(out, "OPTIONS");
    std::vector<const CLI::Option*> shown =
        app.get_options([](const CLI::Option* option) { return !option->get_group().empty(); }); // "": hidden
    // The parser defines --help first; it matters least.
    std::rotate(shown.begin(), shown.begin() + 1, shown.end());
    for (const CLI::Option* option : shown) {
        for (const std::string& line : wrap_text(option_heading(*option), page_width - indent))
            out << std::string(indent, ' ') << line << '\n';
        const std::string value = option->get_default_str();
        paragraphs(out, option->get_description() + "." + (value.empty() ? "" : " Default: " + value + "."),
                   2 * indent);
        out << '\n';
    }
}

} // namespace

std::string manual_page(const Verb& verb) {
    CLI::App app;
    app.set_help_flag("-h,--help", "Show this page");
    // What it returns owns the variables that the options refer to.
    const std::function<void()> owner = verb.define(app);
    std::ostringstream out;
    out << "NAME\n";
    paragraphs(out, std::string("spa ") + verb.name + " - " + verb.summary);
    section(out, "SYNOPSIS");
    paragraphs(out, synopsis(verb, app));
    section(out, "DESCRIPTION");
    paragraphs(out, verb.description);
    options(out, app);
    out << "EXAMPLES\n";
    verbatim(out, verb.examples);
    exit_status(out);
    section(out, "SEE ALSO");
    paragraphs(out, verb.see_also);
    return out.str();
}

std::string manual_page() {
    std::ostringstream out;
    out << "NAME\n";
    paragraphs(out, "spa - bake, look at and unpack spherical maps");
    section(out, "SYNOPSIS");
    paragraphs(out, "spa VERB [argument...]\n\nspa --version");
    section(out, "DESCRIPTION");
    paragraphs(out, about);
    section(out, "VERBS");
    for (const Verb& verb : verbs())
        out << std::string(indent, ' ') << pad_right(verb.name, 10) << verb.summary << '\n';
    out << '\n';
    paragraphs(out, "'spa help VERB' and 'spa VERB --help' show the page of one verb. Results go to standard "
                    "output, everything else to standard error. Outputs appear whole or not at all.");
    section(out, "EXAMPLES");
    verbatim(out, "$ spa sample boot --level 4 -o boot.glb\n"
                  "$ spa bake boot.glb -o boot.spa\n"
                  "$ spa inspect boot.spa --sheet boot.png");
    exit_status(out);
    return out.str();
}

Verb help_verb() {
    return {
        .name = "help",
        .summary = "show the manual page of the command or of one verb",
        .description = "Without a verb: what the command is for and the list of its verbs.",
        .examples = "$ spa help\n$ spa help bake",
        .see_also = "spa bake, spa inspect",
        .define = [](CLI::App& app) -> std::function<void()> {
            auto topic = std::make_shared<std::string>();
            add_text(app, "VERB", "VERB", "The verb to explain",
                     [topic](const std::string& t) { *topic = t; });
            return [topic] {
                if (topic->empty()) return print(manual_page());
                const Verb* verb = find_verb(*topic);
                if (verb == nullptr)
                    throw Error(ExitCode::usage, "there is no verb '" + *topic + "' to explain");
                print(manual_page(*verb));
            };
        },
    };
}

} // namespace spa::tools
