// SPDX-License-Identifier: Apache-2.0
// write_pages FOLDER: writes the pages that browse.py looks at: hostile.html, large.html, and those of maps,
// report_hostile.html and report_large.html, where the command has them.
#include "../../tools/batch_page.h"
#include "../../tools/picture.h"

#include "../support/batch_reports.h"
#ifdef SPA_HAS_REPORT
#include "../../tools/report_page.h"

#include "../support/map_reports.h"
#endif

#include <filesystem>
#include <fstream>
#include <iostream>

namespace {

// Of every second asset; as wide as the asset's place in the report says.
std::vector<std::byte> thumbnail(std::size_t asset) {
    if (asset % 2 != 0) return {};
    return spa::tools::encode_png(spa::tools::Picture(std::uint32_t(10 + asset % 10), 10, {200, 100, 50}));
}

void write(const std::filesystem::path& path, const nlohmann::ordered_json& report) {
    std::ofstream out(path, std::ios::binary);
    spa::tools::write_batch_page(out, report, thumbnail);
    if (!out.flush()) throw std::runtime_error("cannot write " + path.string());
}

#ifdef SPA_HAS_REPORT
void write_maps(const std::filesystem::path& path, const nlohmann::ordered_json& report) {
    std::vector<spa::tools::MapPictures> pictures;
    for (std::size_t i = 0; i < report["maps"].size() && i < 100; ++i) pictures.push_back({thumbnail(i), {}});
    std::ofstream out(path, std::ios::binary);
    spa::tools::write_report_page(out, report, pictures);
    if (!out.flush()) throw std::runtime_error("cannot write " + path.string());
}
#endif

} // namespace

int main(int argc, char** argv) {
    try {
        const std::filesystem::path folder = argc > 1 ? argv[1] : ".";
        std::filesystem::create_directories(folder);
        write(folder / "hostile.html", spa::test::hostile_batch_report());
        write(folder / "large.html", spa::test::large_batch_report(10'000));
#ifdef SPA_HAS_REPORT
        write_maps(folder / "report_hostile.html", spa::test::hostile_map_report());
        write_maps(folder / "report_large.html", spa::test::large_map_report(1000));
#endif
        return 0;
    } catch (const std::exception& error) {
        std::cerr << error.what() << "\n";
        return 1;
    }
}
