// SPDX-License-Identifier: Apache-2.0
#include "arguments.h"
#include "interrupt.h"
#include "map_file.h"
#include "output.h"
#include "surface_file.h"
#include "text.h"
#include "verb.h"

#include <CLI/App.hpp>
#include <nlohmann/json.hpp>

#include <memory>

namespace spa::tools {

namespace {

struct Arguments {
    std::string input;
    std::filesystem::path folder;
    ReportFormat format = ReportFormat::text;
};

struct WrittenFile {
    std::string name;
    std::size_t bytes;
};

class Extraction {
public:
    explicit Extraction(const std::filesystem::path& folder) : staged_(folder) {}

    void add_map(const SphericalMap& map) {
        for (std::size_t p = 0; p < map.parts.size(); ++p) {
            const Part& part = map.parts[p];
            for (std::size_t l = 0; l < part.layers.size(); ++l) {
                const std::string name = "part" + std::to_string(p) + "_layer" + std::to_string(l);
                add_surface(part.layers[l].outer, part.mapping, name + "_outer_");
                add_surface(part.layers[l].inner, part.mapping, name + "_inner_");
            }
        }
        if (!map.metadata.empty()) add("metadata.json", std::as_bytes(std::span(map.metadata)));
    }

    std::vector<WrittenFile> finish() {
        InterruptGuard::check();
        staged_.commit();
        return files_;
    }

private:
    void add_surface(const Surface& surface, Mapping mapping, const std::string& name) {
        if (!surface.color.empty()) add_image(name + "color", color_file(surface.color));
        if (!surface.depth.empty()) add_image(name + "depth", depth_file(surface.depth));
        if (!surface.normal.empty())
            add_image(name + "normal", normal_file(surface.normal, surface.depth, mapping));
    }
    void add_image(const std::string& name, const ImageFile& image) {
        add(name + "." + image.extension, image.bytes);
    }
    void add(const std::string& name, std::span<const std::byte> bytes) {
        InterruptGuard::check();
        staged_.write(name, bytes);
        files_.push_back({name, bytes.size()});
    }

    StagedFolder staged_;
    std::vector<WrittenFile> files_;
};

std::string report(const Arguments& arguments, const std::vector<WrittenFile>& files) {
    if (arguments.format == ReportFormat::json) {
        nlohmann::ordered_json list = nlohmann::ordered_json::array();
        for (const WrittenFile& file : files) list.push_back({{"name", file.name}, {"bytes", file.bytes}});
        return json_text({{"file", arguments.input}, {"folder", arguments.folder.string()}, {"files", list}});
    }
    std::string text;
    for (const WrittenFile& file : files)
        text += (arguments.folder / file.name).string() + "  " + byte_count(file.bytes) + "\n";
    return text;
}

void extract(const Arguments& arguments) {
    check_output_folder(arguments.folder);
    const MapFile file = open_map(arguments.input);
    std::vector<WrittenFile> files;
    {
        const InterruptGuard guard;
        Extraction extraction(arguments.folder);
        extraction.add_map(file.map());
        files = extraction.finish();
    }
    print(report(arguments, files));
}

} // namespace

Verb extract_verb() {
    return {
        .name = "extract",
        .summary = "write the images of a .spa file as PNG and EXR files",
        .description =
            "Writes every image of every part, layer and side, and the metadata, into a folder, which is "
            "made if "
            "it does not exist. The names are partP_layerL_outer_WHAT and partP_layerL_inner_WHAT, with WHAT "
            "one of "
            "color, depth and normal; the metadata is metadata.json.\n\n"
            "color: PNG, 8-bit RGBA, sRGB with straight alpha, as stored.\n\n"
            "depth: r/R, 0 where there is no surface. u8 and u16 become grey PNG of 8 and 16 bits, as "
            "stored; f32 "
            "becomes EXR with one channel, Y.\n\n"
            "normal: rgb8 becomes PNG as stored. oct8 and oct16 are decoded and written as PNG of 3x16 bits, "
            "n/2 + 1/2; black where there is no surface. Normals are in the frame of the part.\n\n"
            "Files of these names that are there already are replaced; others are left alone.",
        .examples = "$ spa extract boot.spa -o boot-images\n"
                    "$ spa extract boot.spa -o boot-images --format json",
        .see_also = "spa inspect",
        .define = [](CLI::App& app) -> std::function<void()> {
            const auto arguments = std::make_shared<Arguments>();
            add_text(app, "FILE", "FILE", "The .spa file; - reads standard input",
                     [arguments](const std::string& text) { arguments->input = text; })
                ->required();
            add_path(app, "-o,--output", "DIR", "The folder to write into", arguments->folder)->required();
            add_report_format(app, arguments->format);
            return [arguments] { extract(*arguments); };
        },
    };
}

} // namespace spa::tools
