// SPDX-License-Identifier: Apache-2.0
// STL, ASCII and binary. A reader of our own, because OpenMesh 9.0's tells the two apart by the word "solid",
// with which many binary files begin, returns no triangle of a binary stream, accepts a cut file and drops
// triangles without saying so.
//
// A file is binary if its size is the one that its triangle count demands, 84 + 50 n, whatever it begins
// with. Facet normals are not used: they are redundant and often wrong, and they would make every surface
// flat; the normals are computed. Attribute bytes, which some programs use for colours in ways of their own,
// are not used.
#include "readers.h"

#include "../../libspa/mesh/weld.h"
#include "polygon_soup.h"
#include "source_file.h"
#include "text.h"

#include <algorithm>
#include <bit>

namespace spa::import {
namespace {

constexpr std::size_t header_size = 84;
constexpr std::size_t triangle_size = 50;

std::uint32_t load_u32(std::string_view bytes, std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i)
        value |= std::uint32_t{static_cast<unsigned char>(bytes[at + i])} << (8 * i);
    return value;
}

float load_float(std::string_view bytes, std::size_t at) { return std::bit_cast<float>(load_u32(bytes, at)); }

std::uint64_t binary_size(std::string_view text) {
    return text.size() < header_size ? 0 : header_size + std::uint64_t{triangle_size} * load_u32(text, 80);
}

void check_corner_count(std::uint64_t count, const std::filesystem::path& path, const Limits& limits) {
    const std::uint64_t most = std::min(limits.triangles, (std::uint64_t{no_index} - 1) / 3);
    if (count > 3 * most)
        fail(path, "has more than the " + std::to_string(most) +
                       " triangles allowed; simplify the mesh or raise the limit");
}

void add_corner(PolygonSoup& soup, Vec3f position) {
    PolygonCorner corner;
    corner.position = std::uint32_t(soup.positions.size());
    soup.corners.push_back(corner);
    soup.positions.push_back(position);
}

void read_binary(std::string_view text, PolygonSoup& soup, const std::filesystem::path& path,
                 const Limits& limits) {
    const std::uint32_t count = load_u32(text, 80);
    check_corner_count(std::uint64_t{count} * 3, path, limits);
    soup.positions.reserve(std::size_t{count} * 3);
    soup.corners.reserve(std::size_t{count} * 3);
    soup.polygons.reserve(count);
    for (std::uint32_t t = 0; t < count; ++t) {
        const std::size_t at = header_size + std::size_t{t} * triangle_size + 12; // after the facet normal
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t p = at + 12 * k;
            add_corner(soup, {load_float(text, p), load_float(text, p + 4), load_float(text, p + 8)});
        }
        add_polygon(soup, {3, 0}, path, limits);
    }
}

class AsciiReader {
public:
    AsciiReader(std::string_view text, const std::filesystem::path& path, const Limits& limits)
        : path_(path), limits_(limits), tokens_{{text}, {}} {}

    void read(PolygonSoup& soup) {
        for (std::string_view word = tokens_.read(); !word.empty(); word = tokens_.read()) {
            if (!equal_ignoring_case(word, "solid")) refuse("expected 'solid'", word);
            tokens_.rest = {}; // the name
            read_solid(soup);
        }
    }

private:
    [[noreturn]] void refuse(const std::string& expected, std::string_view found) const {
        fail(path_, tokens_.lines.line,
             expected + (found.empty() ? ", but the file ends; it is cut off" : ", found " + quote(found)));
    }

    void expect(std::string_view word) {
        const std::string_view found = tokens_.read();
        if (!equal_ignoring_case(found, word)) refuse("expected " + quote(word), found);
    }

    float number() {
        const std::string_view token = tokens_.read();
        const auto value = parse_float(token);
        if (!value) refuse("expected a number", token);
        return *value;
    }

    void read_solid(PolygonSoup& soup) {
        for (;;) {
            const std::string_view word = tokens_.read();
            if (equal_ignoring_case(word, "endsolid")) break;
            if (!equal_ignoring_case(word, "facet")) refuse("expected 'facet' or 'endsolid'", word);
            read_facet(soup);
        }
        tokens_.rest = {}; // the name
    }

    void read_facet(PolygonSoup& soup) {
        expect("normal");
        for (int i = 0; i < 3; ++i) (void)number();
        expect("outer");
        expect("loop");
        std::uint32_t count = 0;
        for (;; ++count) {
            const std::string_view word = tokens_.read();
            if (equal_ignoring_case(word, "endloop")) break;
            if (!equal_ignoring_case(word, "vertex")) refuse("expected 'vertex' or 'endloop'", word);
            check_corner_count(soup.positions.size() + 1, path_, limits_);
            const float x = number();
            const float y = number();
            const float z = number();
            add_corner(soup, {x, y, z});
        }
        if (count < 3)
            fail(path_, tokens_.lines.line,
                 "a facet needs three vertices, here are " + std::to_string(count));
        expect("endfacet");
        add_polygon(soup, {count, 0}, path_, limits_);
    }

    const std::filesystem::path& path_;
    const Limits& limits_;
    TokenReader tokens_;
};

// Corners of equal position share one, so that the model has vertices with several triangles.
void weld(PolygonSoup& soup) {
    const std::vector<std::uint32_t> first = weld_positions(soup.positions);
    for (PolygonCorner& corner : soup.corners) corner.position = first[corner.position];
}

} // namespace

Result read_stl(const Asset& asset, const Limits& limits) {
    const std::string_view text(reinterpret_cast<const char*>(asset.file.bytes.data()),
                                asset.file.bytes.size());
    Result result;
    result.report.format = "STL";
    const References references(asset, limits, result.report);
    PolygonSoup soup;
    soup.materials.emplace_back();
    soup.materials[0].name = "default";
    const std::string_view words = as_text(asset.file.bytes).substr(0, 512);
    if (binary_size(text) == text.size() && text.size() >= header_size) {
        read_binary(text, soup, asset.path, limits);
    } else if (equal_ignoring_case(trim(words).substr(0, 5), "solid")) {
        AsciiReader(as_text(asset.file.bytes), asset.path, limits).read(soup);
    } else if (text.size() < header_size) {
        fail(asset.path,
             "neither ASCII STL (it does not begin with 'solid') nor binary (it is shorter than the header "
             "of 84 bytes)");
    } else {
        fail(asset.path, "damaged binary STL: its header declares " + std::to_string(load_u32(text, 80)) +
                             " triangles, which take " + std::to_string(binary_size(text)) +
                             " bytes, but the file has " + std::to_string(text.size()));
    }
    weld(soup);
    result.model = to_model(std::move(soup), asset.path, limits, result.report);
    return result;
}

} // namespace spa::import
