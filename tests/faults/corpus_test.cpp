// SPDX-License-Identifier: Apache-2.0
// Real assets and malformed ones in one batch.
#include "batch_folder.h"

#include <cstdlib>
#include <set>

namespace spa::test {
namespace {

namespace fs = std::filesystem;

// Usable, and nothing to say about it.
const std::set<std::string> harmless = {"malformed/gltf_draco/TexCoord0InvalidTexCoord1Valid.gltf",
                                        "malformed/obj/deg_faces.obj", "malformed/obj/regr_3429812.obj",
                                        "malformed/stl/busted.STL"};
// Not in the folder of malformed ones, but all it has are points.
const std::string empty = "obj/misc/number_formats.obj";

TEST(Corpus, GoodAssetsAreBakedAndBadOnesNamed) {
    const char* const variable = std::getenv("SPA_ASSETS");
    const fs::path assets = variable != nullptr ? variable : SPA_ASSETS_DIR;
    if (!fs::exists(assets)) GTEST_SKIP() << "no assets: set SPA_ASSETS to their folder";
    const BatchFolder folder;
    // Without the largest.
    const std::vector<std::string> arguments = {
        "batch",    assets.string(), "-o",     "out",       "--size",    "8",         "--jobs",
        "2",        "--exclude",     "big/**", "--exclude", "scenes/**", "--exclude", "gltf/bio_24_*/**",
        "--report", "report.json"};
    const Outcome outcome = run_spa(arguments, folder.path());
    EXPECT_EQ(outcome.exit_code, 3);
    const nlohmann::json report = folder.report();
    EXPECT_GT(report["counts"]["baked"], 100);
    EXPECT_GT(report["counts"]["failed"], 80);
    EXPECT_TRUE(folder.others().empty());
    std::size_t maps = 0, baked = 0;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder.out()))
        if (entry.is_regular_file()) ++maps;
    for (const nlohmann::json& asset : report["assets"]) {
        const std::string name = asset["source"];
        SCOPED_TRACE(asset.dump(1));
        const bool is_good = !name.starts_with("malformed/") && name != empty;
        EXPECT_EQ(asset["signal"], nullptr);
        if (asset["status"] == "failed") {
            EXPECT_FALSE(is_good);
            EXPECT_TRUE(std::set({2, 3, 5}).contains(asset["exit_code"].get<int>()));
            EXPECT_TRUE(says(asset["error"], (assets / name).string() + ": "));
            EXPECT_TRUE(says(outcome.err, name + ": failed"));
            continue;
        }
        ASSERT_EQ(asset["status"], "baked");
        EXPECT_TRUE(is_good || harmless.contains(name) || !asset["warnings"].empty());
        EXPECT_TRUE(is_whole(folder.path() / asset["output"].get<std::string>()));
        if (++baked % 15 != 0) continue; // a start of the command costs more than the bake
        ASSERT_EQ(run_spa({"bake", (assets / name).string(), "-o", "one.spa", "--size", "8"}, folder.path())
                      .exit_code,
                  0);
        EXPECT_TRUE(read_file(folder.path() / "one.spa") ==
                    read_file(folder.path() / asset["output"].get<std::string>()));
    }
    EXPECT_EQ(maps, baked);
    const Outcome again = run_spa(arguments, folder.path());
    EXPECT_EQ(again.exit_code, 3);
    EXPECT_EQ(folder.report()["counts"]["up_to_date"], baked);
    EXPECT_EQ(folder.report()["counts"]["failed"], report["counts"]["failed"]);
}

} // namespace
} // namespace spa::test
