// SPDX-License-Identifier: Apache-2.0
// A program of somebody else: includes every installed header, writes a small `.spa` file under the name it
// is given, opens it again and compares.
#include <formats/container/check.h>
#include <formats/container/format.h>
#include <formats/container/limits.h>
#include <formats/container/reader.h>
#include <formats/container/source.h>
#include <formats/container/status.h>
#include <formats/container/writer.h>
#include <libspa/core/direction_map.h>
#include <libspa/core/element_format.h>
#include <libspa/core/error.h>
#include <libspa/core/spherical_map.h>
#include <libspa/core/vector.h>

#include <algorithm>
#include <cstdio>
#include <vector>

namespace {

std::vector<std::byte> filled(std::size_t bytes, int value) {
    return std::vector<std::byte>(bytes, std::byte(value));
}

int fail(const char* what) {
    std::fprintf(stderr, "consumer: %s\n", what);
    return 1;
}

} // namespace

int main(int argc, char** argv) {
    if (argc != 2) return fail("name the file to write");

    const spa::Grid grid{spa::Mapping::octahedral, 9, 9};
    const std::size_t samples = std::size_t(grid.width) * grid.height;
    const auto color = filled(samples * 4, 255), depth = filled(samples, 128),
               normal = filled(samples * 2, 0);

    spa::Layer layer;
    layer.outer.color = {color, grid.width, grid.height, spa::ElementFormat::rgba8};
    layer.outer.depth = {depth, grid.width, grid.height, spa::ElementFormat::u8};
    layer.outer.normal = {normal, grid.width, grid.height, spa::ElementFormat::oct8};
    spa::Part part;
    part.mapping = grid.mapping;
    part.radius = 2;
    part.layers = {layer};
    spa::SphericalMap map;
    map.parts = {part};

    const auto written = spa::container::write(map, {}, std::string(argv[1]));
    if (!written.ok()) return fail("the map could not be written");

    spa::container::File file;
    const auto opened = spa::container::open(argv[1], file);
    if (!opened.ok()) return fail("the file could not be opened");
    if (file.map().parts.size() != 1 || file.map().parts[0].layers.size() != 1)
        return fail("the file does not hold one part with one layer");
    const spa::Surface& surface = file.map().parts[0].layers[0].outer;
    if (!std::equal(depth.begin(), depth.end(), surface.depth.bytes.begin(), surface.depth.bytes.end()))
        return fail("the depth came back different");
    const spa::Vec3d direction = spa::sample_direction(grid, {4, 4});
    if (direction != spa::Vec3d{0, 0, 1}) return fail("the middle sample does not look along +Z");
    std::printf("%zu samples came back\n", samples);
    return 0;
}
