// SPDX-License-Identifier: Apache-2.0
// Writes test files (`dump_spa --write FOLDER`), and prints what the C++ reader makes of one (`dump_spa
// FILE`) in the text form of read_spa.py.
#include "../container/test_maps.h"

#include "../../formats/container/reader.h"
#include "../../formats/container/writer.h"
#include "../../libspa/core/folds.h"

#include <cmath>
#include <cstdio>
#include <string>

namespace {

using namespace spa;

void print(double value) {
    std::isnan(value) ? void(std::printf(" nan")) : void(std::printf(" %.9g", value));
}
void print(Vec3d v) {
    print(v.x);
    print(v.y);
    print(v.z);
}

void print_depth(const Part& part, const ImageView& image, std::uint32_t x, std::uint32_t y) {
    const double depth = double(decode_depth(image.format, image.at(x, y)));
    const Vec3d u = normalize(sample_direction({part.mapping, image.width, image.height}, {x, y}));
    print(depth);
    print(u);
    print(part.center + part.frame * (u * (depth * part.radius)));
}

void print_element(const Part& part, const char* type, const ImageView& image, std::uint32_t x,
                   std::uint32_t y) {
    if (type[0] == 'D') {
        print_depth(part, image, x, y);
    } else if (type[0] == 'N') {
        print(to_double(decode_normal(image.format, image.at(x, y))));
    } else {
        for (int c = 0; c < 4; ++c) std::printf(" %d", std::to_integer<int>(image.at(x, y)[c]));
    }
    std::printf("\n");
}

void print_image(const Part& part, const char* type, const std::string& place, const ImageView& image) {
    if (image.empty()) return;
    std::printf("image %s %s %s %u %u\n", type, place.c_str(), name(image.format), image.width, image.height);
    for (std::uint32_t y = 0; y < image.height; ++y)
        for (std::uint32_t x = 0; x < image.width; ++x) print_element(part, type, image, x, y);
}

// One line a triangle, with the directions of its corners.
void print_mixed(const Part& part, std::size_t index) {
    const ImageView& depth = part.layers[0].outer.depth;
    const std::uint32_t cells = depth.width - 1;
    std::printf("mixed %zu %u\n", index, cells);
    for (std::uint32_t y = 0; y < cells; ++y) {
        for (std::uint32_t x = 0; x < cells; ++x) {
            for (const unsigned triangle : {0U, 1U}) {
                std::printf("%d", int(is_mixed(part.mixed, triangle_bit(cells, x, y, triangle))));
                for (const TexelIndex corner : triangle_corners(cells, x, y, triangle))
                    print(normalize(sample_direction({part.mapping, depth.width, depth.height}, corner)));
                std::printf("\n");
            }
        }
    }
}

// One line a record, with the samples at its ends and the points of its cut.
void print_folds(const Part& part, std::size_t index) {
    const ImageView& depth = part.layers[0].outer.depth;
    const std::vector<FoldRecord> records = decode_folds(part.folds);
    std::printf("folds %zu %zu\n", index, records.size());
    for (const FoldRecord& r : records) {
        const std::array<TexelIndex, 2> ends = edge_ends(depth.width - 1, r.edge);
        std::printf("%u %u %d %u %u %u %u %u %u", r.edge, unsigned(r.end), int(r.pair), unsigned(r.index),
                    unsigned(r.place), ends[0].x, ends[0].y, ends[1].x, ends[1].y);
        const Grid grid{part.mapping, depth.width, depth.height};
        const Vec3d from = sample_direction(grid, ends[r.end]), to = sample_direction(grid, ends[1U - r.end]);
        const Vec3d u = normalize(from + (to - from) * fold_position(r.place));
        for (const std::uint16_t code : r.cut) {
            if (code == 0) continue;
            const double d = code / 65535.0;
            print(d);
            print(part.center + part.frame * (u * (d * part.radius)));
        }
        std::printf("\n");
    }
}

void print_map(const SphericalMap& map) {
    std::printf("metadata ");
    for (const char c : map.metadata) std::printf("%02x", unsigned(std::uint8_t(c)));
    std::printf("\n");
    for (std::size_t i = 0; i < map.parts.size(); ++i) {
        const Part& part = map.parts[i];
        std::printf("part %zu %u %zu %d %d %d", i, unsigned(part.mapping), part.layers.size(), part.node,
                    part.joint, int(part.center_inside));
        print(part.center);
        print(part.radius);
        for (const Vec3d& row : part.frame.row) print(row);
        const ErrorFigures& e = part.errors;
        for (const float figure :
             {e.texel_distance_max, e.texel_distance_mean, e.surface_distance_max, e.surface_distance_mean,
              e.captured_area, e.normal_angle_mean, e.color_difference_mean, e.quantization_bound})
            print(double(figure));
        std::printf("\n");
        for (std::size_t k = 0; k < part.layers.size(); ++k) {
            for (int side = 0; side < 2; ++side) {
                const Surface& surface = side == 0 ? part.layers[k].outer : part.layers[k].inner;
                const std::string place =
                    std::to_string(i) + " " + std::to_string(k) + " " + std::to_string(side);
                print_image(part, "DPTH", place, surface.depth);
                print_image(part, "NRML", place, surface.normal);
                print_image(part, "COLR", place, surface.color);
            }
        }
        if (part.to_node != Affine{}) {
            std::printf("bind %zu", i);
            for (const Vec3d& row : part.to_node.linear.row) print(row);
            print(part.to_node.translation);
            std::printf("\n");
        }
        if (!part.mixed.empty()) print_mixed(part, i);
        if (!part.folds.empty()) print_folds(part, i);
    }
}

int write_files(const std::string& folder) {
    using enum ElementFormat;
    test::TestPart latlong{
        .mapping = Mapping::latlong, .width = 12, .height = 7, .color_width = 4, .color_height = 3};
    latlong.depth = f32;
    latlong.normal = rgb8;
    test::TestPart bytes;
    bytes.depth = u8;
    bytes.normal = oct8;
    bytes.solid_core = false;
    bytes.center_inside = false;
    bytes.width = bytes.height = 7; // rows of triangles that do not fill whole bytes
    const test::TestMap map =
        test::make_map({test::TestPart{}, latlong, bytes}, "{\"name\":\"\\u00e9 \xC3\xA9\"}");
    for (const auto& [compression, name] : {std::pair(container::Compression::none, "/none.spa"),
                                            std::pair(container::Compression::zstd, "/zstd.spa")}) {
        const container::Status status =
            container::write(map.map, {.compression = compression}, folder + name);
        if (status.ok()) continue;
        std::fprintf(stderr, "%s\n", container::describe(status, folder + name).c_str());
        return 2;
    }
    return 0;
}

} // namespace

int main(int argc, char** argv) {
    if (argc == 3 && std::string(argv[1]) == "--write") return write_files(argv[2]);
    if (argc != 2) return 1;
    container::File file;
    const container::Status status = container::open(std::string(argv[1]), file);
    if (!status.ok()) {
        std::fprintf(stderr, "%s\n", container::describe(status, argv[1]).c_str());
        return 3;
    }
    print_map(file.map());
    return 0;
}
