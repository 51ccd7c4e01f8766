// SPDX-License-Identifier: Apache-2.0
// OFF (Geomview's object file format), ASCII: OFF, COFF, NOFF, STOFF and their combinations, comments,
// polygons, vertex normals, colours and texture coordinates, face colours. A reader of our own, because
// OpenMesh 9.0's never returns from an empty file or an absurd count, reads garbage after a comment line
// (comments.off), and accepts words that are no numbers and indices of vertices that do not exist.
//
// Colours are display values, 0..255 or, if any has a decimal point or none exceeds 1, 0..1; sRGB, made
// linear. Vertex colours win over face colours. A single number as face colour is an index into a table that
// is not in the file; it is passed over.
#include "readers.h"

#include "polygon_soup.h"
#include "source_file.h"
#include "text.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string>

namespace spa::import {
namespace {

// What the keyword before "OFF" says about vertices, in this order.
struct OffKind {
    bool uvs = false, colors = false, normals = false;
};

class OffReader {
public:
    OffReader(std::string_view text, const std::filesystem::path& path, const Limits& limits, Report& report)
        : path_(path), limits_(limits), report_(report), lines_{text} {}

    PolygonSoup read() {
        read_header();
        for (std::uint64_t i = 0; i < vertex_count_; ++i) read_vertex(i);
        for (std::uint64_t i = 0; i < face_count_; ++i) read_face(i);
        if (next_line()) warn(report_, "There is more data after the last face; it was passed over.");
        finish_colors();
        soup_.materials.emplace_back();
        soup_.materials[0].name = "default";
        const auto translucent = [](const Vec4f& color) { return color.w < 1; };
        if (std::any_of(soup_.colors.begin(), soup_.colors.end(), translucent))
            soup_.materials[0].alpha_mode = AlphaMode::blend;
        return std::move(soup_);
    }

private:
    // The next line that has more than blanks and a comment.
    bool next_line() {
        while (const auto line = lines_.read()) {
            rest_ = trim(line->substr(0, line->find('#')));
            if (!rest_.empty()) return true;
        }
        rest_ = {};
        return false;
    }

    void need_line(const std::string& what) {
        if (!next_line())
            fail(path_, std::max(lines_.line, std::size_t{1}),
                 "the file ends before " + what + "; it is cut off");
    }

    std::uint64_t count(const char* what) {
        const std::string_view token = cut_token(rest_);
        const auto value = parse_integer(token);
        if (!value || *value < 0)
            fail(path_, lines_.line,
                 std::string("expected the number of ") + what + ", found " + quote(token));
        return std::uint64_t(*value);
    }

    float number(const char* what) {
        const std::string_view token = cut_token(rest_);
        const auto value = parse_float(token);
        if (!value) fail(path_, lines_.line, std::string("expected ") + what + ", found " + quote(token));
        return *value;
    }

    void read_header() {
        need_line("the header");
        std::string_view peek = rest_;
        std::string_view keyword = cut_token(peek);
        if (keyword.ends_with("OFF")) {
            rest_ = peek;
            keyword.remove_suffix(3);
            const auto cut = [&](std::string_view prefix) {
                if (!keyword.starts_with(prefix)) return false;
                keyword.remove_prefix(prefix.size());
                return true;
            };
            kind_.uvs = cut("ST");
            kind_.colors = cut("C");
            kind_.normals = cut("N");
            if (!keyword.empty())
                fail(path_, lines_.line,
                     quote(std::string(keyword) + "OFF") + " has vertices of other than three dimensions");
            if (equal_ignoring_case(trim(rest_), "binary"))
                fail(path_, lines_.line, "binary OFF is not read; convert it to ASCII OFF or PLY");
            if (trim(rest_).empty()) need_line("the counts");
        }
        vertex_count_ = count("vertices");
        face_count_ = count("faces"); // the number of edges after it means nothing
        const std::size_t left = lines_.text.size() - std::min(lines_.next, lines_.text.size());
        // "0 0 0" and "0" with a line end; the last needs none.
        if (vertex_count_ > (left + 1) / 6 || face_count_ > (left + 1) / 2)
            fail(path_, lines_.line,
                 "the header declares " + std::to_string(vertex_count_) + " vertices and " +
                     std::to_string(face_count_) + " faces, more than the remaining " + std::to_string(left) +
                     " bytes can hold; the file is cut off or damaged");
        check_vertex_count(vertex_count_, path_, limits_);
    }

    void read_vertex(std::uint64_t i) {
        need_line("vertex " + std::to_string(i + 1) + " of " + std::to_string(vertex_count_));
        const float x = number("a coordinate");
        const float y = number("a coordinate");
        const float z = number("a coordinate");
        soup_.positions.push_back({x, y, z});
        if (kind_.normals) {
            const float nx = number("a normal component");
            const float ny = number("a normal component");
            const float nz = number("a normal component");
            soup_.normals.push_back({nx, ny, nz});
        }
        if (kind_.colors) {
            // Three or four numbers: only the end of the line tells.
            const std::size_t behind = kind_.uvs ? 2 : 0;
            const std::size_t words = count_words(rest_);
            if (words != 3 + behind && words != 4 + behind)
                fail(path_, lines_.line, "expected a colour of three or four numbers");
            vertex_colors_.push_back(color(words - behind));
        }
        if (kind_.uvs) {
            const float u = number("a texture coordinate");
            const float v = number("a texture coordinate");
            soup_.uvs.push_back({u, 1 - v});
        }
        if (!trim(rest_).empty())
            warn(report_,
                 "Vertices have more numbers than the header '...OFF' announces; they were passed over.");
    }

    static std::size_t count_words(std::string_view text) {
        std::size_t count = 0;
        while (!cut_token(text).empty()) ++count;
        return count;
    }

    Vec4f color(std::size_t words) {
        std::array<float, 4> values{0, 0, 0, -1};
        for (std::size_t k = 0; k < words; ++k) {
            std::string_view peek = rest_;
            if (cut_token(peek).find_first_of(".eE") != std::string_view::npos) fractions_ = true;
            values[k] = number("a colour component");
            if (values[k] > 1) above_one_ = true;
        }
        return {values[0], values[1], values[2], values[3]};
    }

    void read_face(std::uint64_t i) {
        need_line("face " + std::to_string(i + 1) + " of " + std::to_string(face_count_));
        const std::uint64_t corners = count("vertices of a face");
        if (corners < 3) {
            ++report_.ignored_primitives;
            return;
        }
        // Each index takes at least a blank and a digit.
        if (corners > rest_.size() / 2)
            fail(path_, lines_.line,
                 "a face declares " + std::to_string(corners) + " vertices, more than the line has");
        const std::size_t first = soup_.corners.size();
        for (std::uint64_t k = 0; k < corners; ++k) {
            const std::string_view token = cut_token(rest_);
            const auto index = parse_integer(token);
            if (!index || *index < 0 || std::uint64_t(*index) >= vertex_count_)
                fail(path_, lines_.line,
                     "the vertex index " + quote(token) + " is out of range; there are " +
                         std::to_string(vertex_count_) + " vertices");
            PolygonCorner corner;
            corner.position = std::uint32_t(*index);
            if (kind_.normals) corner.normal = corner.position;
            if (kind_.uvs) corner.uv = corner.position;
            if (kind_.colors) corner.color = corner.position;
            soup_.corners.push_back(corner);
        }
        add_polygon(soup_, {std::uint32_t(corners), 0}, path_, limits_);
        const std::size_t words = count_words(rest_);
        if (kind_.colors || words < 3) return;
        for (std::size_t c = first; c < soup_.corners.size(); ++c)
            soup_.corners[c].color = std::uint32_t(face_colors_.size());
        face_colors_.push_back(color(std::min(words, std::size_t{4})));
    }

    // Whether colours go to 1 or to 255 is known only now.
    void finish_colors() {
        soup_.colors = kind_.colors ? std::move(vertex_colors_) : std::move(face_colors_);
        const float scale = fractions_ || !above_one_ ? 1.0F : 1.0F / 255.0F;
        for (Vec4f& c : soup_.colors)
            c = display_to_linear({c.x * scale, c.y * scale, c.z * scale, c.w < 0 ? 1.0F : c.w * scale});
    }

    const std::filesystem::path& path_;
    const Limits& limits_;
    Report& report_;
    LineReader lines_;
    std::string_view rest_; // of the current line
    OffKind kind_;
    std::uint64_t vertex_count_ = 0, face_count_ = 0;
    PolygonSoup soup_;
    std::vector<Vec4f> vertex_colors_, face_colors_; // as in the file; alpha -1 = none given
    bool fractions_ = false, above_one_ = false;     // seen in colours
};

} // namespace

Result read_off(const Asset& asset, const Limits& limits) {
    Result result;
    result.report.format = "OFF";
    const References references(asset, limits, result.report);
    PolygonSoup soup = OffReader(as_text(asset.file.bytes), asset.path, limits, result.report).read();
    result.model = to_model(std::move(soup), asset.path, limits, result.report);
    return result;
}

} // namespace spa::import
