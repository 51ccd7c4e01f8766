// SPDX-License-Identifier: Apache-2.0
// File names may have any bytes but '/' and zero.
#include "assets.h"
#include "batch_folder.h"

#include <sys/stat.h>

namespace spa::test {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> strange_names = {
    "with space",
    " ",
    "new\nline",
    "tab\tand\rreturn",
    "quotes\"'`",
    "-dash",
    "--help",
    "-o",
    "@list",
    "*",
    "?",
    "[a-c]",
    "{a,b}",
    "!not",
    "#comment",
    "back\\slash",
    "$HOME;true|false&",
    "%2e%2E",
    "semi:colon",
    "a.obj",
    ".hidden",
    "...",
    "\x1b[31mred",
    "\x7f",
    "ünïcödé",
    "u\u0308",
    "\xff\xfe",
    "half \xe2\x82",
    "\xc0\xaf",
    "\xed\xa0\x80",
    "<b>&amp;",
    "<script>",
    std::string(251, 'n'),
    std::string(249, 'n') + "\xc3\xa4",
    "con",
    "null",
};

TEST(Names, OfFilesMayBeAnything) {
    BatchFolder folder;
    for (const std::string& name : strange_names) folder.add(name + ".obj", obj(1));
    const Outcome outcome = folder.run({"--report", "report.json", "--report", "report.html"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_TRUE(folder.is_complete());
    EXPECT_EQ(folder.report()["counts"]["baked"], strange_names.size());
    EXPECT_TRUE(says(read_file(folder.path() / "report.html"), "</html>"));
    // A line an asset, whatever is in its name, and no escape sequence for the terminal.
    EXPECT_EQ(std::size_t(std::count(outcome.err.begin(), outcome.err.end(), '\n')), strange_names.size());
    EXPECT_EQ(outcome.err.find('\x1b'), std::string::npos);

    const Outcome again = folder.run({"--report", "report.json"});
    EXPECT_EQ(again.exit_code, 0);
    EXPECT_TRUE(says(again.out, std::to_string(strange_names.size()) + " up to date"));
    EXPECT_EQ(folder.report()["counts"]["up_to_date"], strange_names.size());

    // The same files in a list ended by zero bytes, and on the command line.
    std::string list;
    std::vector<std::string> arguments{"batch", "-o", "../out", "--size", "16", "--"};
    for (const std::string& name : strange_names) {
        list += name + ".obj" + '\0';
        if (name[0] != '@') arguments.push_back(name + ".obj");
    }
    const Outcome listed = run_spa({"batch", "-", "-o", "../out", "--size", "16"}, folder.in(), list);
    EXPECT_TRUE(says(listed.out, std::to_string(strange_names.size()) + " up to date")) << listed.err;
    const Outcome named = run_spa(arguments, folder.in());
    EXPECT_TRUE(says(named.out, std::to_string(strange_names.size() - 1) + " up to date")) << named.err;
}

TEST(Names, OfFoldersMayBeAnything) {
    BatchFolder folder;
    std::string deep;
    for (const std::string& name : strange_names) {
        if (name == "...") continue;
        folder.add(name + "/a.obj", obj(1));
        if (deep.size() < 800) deep += name + "/";
    }
    folder.add(deep + "b.obj", obj(2));
    const Outcome outcome = folder.run({"--report", "report.json"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_TRUE(folder.is_complete());
    EXPECT_EQ(folder.report()["counts"]["baked"], folder.assets().size());
    EXPECT_TRUE(says(folder.run().out, std::to_string(folder.assets().size()) + " up to date"));
}

TEST(Names, OfFilesThatAreReferredTo) {
    BatchFolder folder;
    const std::vector<std::string> names = {"two words", "ünï", "\xff\xfe", "-dash", "50%", "it's"};
    for (std::size_t i = 0; i < names.size(); ++i) {
        const std::string place = std::to_string(i) + "/";
        folder.add(place + "a.obj", obj(1, names[i] + ".mtl"));
        folder.write(place + names[i] + ".mtl", mtl_with_picture(names[i] + ".png"));
        folder.write(place + names[i] + ".png", red_png());
    }
    const Outcome outcome = folder.run({"--report", "report.json"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    const nlohmann::json report = folder.report();
    for (const nlohmann::json& asset : report["assets"]) EXPECT_TRUE(asset["warnings"].empty()) << asset;
    EXPECT_TRUE(folder.is_complete());
    EXPECT_TRUE(says(folder.run().out, "6 up to date"));
    for (std::size_t i = 0; i < names.size(); ++i)
        folder.write(std::to_string(i) + "/" + names[i] + ".png", blue_png());
    EXPECT_TRUE(says(folder.run().out, "6 baked"));
    EXPECT_TRUE(folder.is_complete());
}

TEST(Names, OfAssetsThatFail) {
    BatchFolder folder;
    for (const std::string& name : strange_names) folder.write(name + ".obj", "v 0 0");
    const Outcome outcome = folder.run({"--report", "report.json", "--report", "report.html"});
    EXPECT_EQ(outcome.exit_code, 3);
    EXPECT_EQ(folder.report()["counts"]["failed"], strange_names.size());
    EXPECT_EQ(outcome.err.find('\x1b'), std::string::npos);
    EXPECT_EQ(outcome.out.find('\x1b'), std::string::npos);
    EXPECT_TRUE(says(outcome.err, "new\\nline.obj: failed, exit 3: in/new\\nline.obj: "));
    EXPECT_TRUE(says(outcome.err, "\\xff\\xfe.obj: failed, exit 3: in/\\xff\\xfe.obj: "));
    EXPECT_TRUE(folder.others().empty());
}

// The longest names that a folder takes leave room for ".spa", and no more.
TEST(Names, OneThatGetsTooLongFailsAlone) {
    BatchFolder folder;
    const std::string name(251, 'n');
    folder.add("good.obj", obj(1));
    folder.write(name + ".obj", obj(1));
    folder.write(name + ".ply", "ply"); // so that both keep their extensions
    const Outcome outcome = folder.run();
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_TRUE(says(outcome.err, "out/" + name + ".obj.spa: "));
    EXPECT_TRUE(says(outcome.err, "File name too long"));
    EXPECT_TRUE(folder.is_complete());
}

} // namespace
} // namespace spa::test
