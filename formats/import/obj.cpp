// SPDX-License-Identifier: Apache-2.0
// Wavefront OBJ, as "Advanced Visualizer, appendix B: object files" defines its polygons. A reader of our
// own, because tinyobjloader 2.0 (rc10) takes "nan" and unreadable numbers for 0, accepts indices of vertices
// that do not exist, drops triangles when it cuts n-gons, fails on a "1//" corner and says no line, and
// OpenMesh drops faces that make its mesh non-manifold.
//
// Read: v (with colours: x y z r g b, or x y z w r g b), vt, vn, f (and its old name fo) with absolute and
// relative indices and any number of corners, usemtl, mtllib, line continuations. Counted: p and l. Names
// of objects and groups make the nodes of a scene. Passed over: smoothing groups (without vn, the crease
// angle decides); display settings; subdivision tags. Free-form curves and surfaces and unknown statements:
// passed over with a warning. A number in a v, vt or vn that cannot be read is undefined (NaN), and the faces
// that use it are dropped, with warnings; a wrong face is an error.
#include "readers.h"

#include "obj_materials.h"
#include "obj_nodes.h"
#include "polygon_soup.h"
#include "source_file.h"
#include "text.h"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <string>

namespace spa::import {
namespace {

constexpr std::array<std::string_view, 23> passed_over{
    "o",      "g",      "s",          "mg",        "bevel", "c_interp", "d_interp", "lod",
    "maplib", "usemap", "shadow_obj", "trace_obj", "t",     "end",      "vp",       "parm",
    "trim",   "hole",   "scrv",       "sp",        "con",   "ctech",    "stech"};
constexpr std::array<std::string_view, 7> free_form{"curv", "curv2", "surf", "cstype", "deg", "bmat", "step"};

template <class Words>
bool contains(const Words& words, std::string_view word) {
    return std::find(words.begin(), words.end(), word) != words.end();
}

// Logical lines: a backslash at the end of a line joins the next one to it.
struct ObjLines {
    LineReader lines;
    std::size_t line = 0; // number of the first line of the last logical one
    std::string joined;

    std::optional<std::string_view> read() {
        auto part = lines.read();
        line = lines.line;
        if (!part || !part->ends_with('\\')) return part;
        joined.clear();
        while (part && part->ends_with('\\')) {
            part->remove_suffix(1);
            joined.append(*part).append(1, ' ');
            part = lines.read();
        }
        if (part) joined.append(*part);
        return joined;
    }
};

// A '#' in the middle of a word belongs to it: 1.#IND, file names.
std::string_view strip_comment(std::string_view line) {
    for (std::size_t i = line.find('#'); i != std::string_view::npos; i = line.find('#', i + 1)) {
        if (i == 0 || line[i - 1] == ' ' || line[i - 1] == '\t') return line.substr(0, i);
    }
    return line;
}

class ObjParser {
public:
    // nodes: where objects and groups are kept; null where nobody asks for them.
    ObjParser(const Asset& asset, const Limits& limits, Report& report, ObjNodes* nodes)
        : path_(asset.path), limits_(limits), report_(report), materials_(asset, limits, report),
          nodes_(nodes) {}

    PolygonSoup parse(std::string_view text) {
        ObjLines lines;
        lines.lines.text = text;
        while (const auto line = lines.read()) {
            line_ = lines.line;
            std::string_view rest = strip_comment(*line);
            const std::string_view keyword = cut_token(rest);
            if (!keyword.empty()) statement(keyword, trim(rest));
        }
        drop_absent_attributes();
        check_indices();
        make_materials();
        warn_of_leftovers();
        return std::move(soup_);
    }

private:
    void statement(std::string_view keyword, std::string_view rest) {
        if (keyword == "v")
            vertex(rest);
        else if (keyword == "vt")
            texture_vertex(rest);
        else if (keyword == "vn")
            normal(rest);
        else if (keyword == "f" || keyword == "fo")
            face(rest);
        else if (keyword == "p" || keyword == "l")
            ++report_.ignored_primitives;
        else if (keyword == "usemtl")
            use_material(rest);
        else if (keyword == "mtllib")
            materials_.read_libraries(rest, line_);
        else if (nodes_ != nullptr && keyword == "o")
            nodes_->begin_object(rest);
        else if (nodes_ != nullptr && keyword == "g")
            nodes_->begin_group(rest);
        else if (contains(free_form, keyword))
            note(free_form_, keyword);
        else if (!contains(passed_over, keyword))
            note(unknown_, keyword);
    }

    // At most seven numbers; returns how many.
    std::size_t numbers(std::string_view rest, std::array<float, 7>& values) {
        std::size_t count = 0;
        for (auto token = cut_token(rest); !token.empty() && count < values.size(); token = cut_token(rest)) {
            const auto value = parse_float(token);
            if (!value) note(unreadable_, token);
            values[count++] = value.value_or(std::numeric_limits<float>::quiet_NaN());
        }
        return count;
    }

    void vertex(std::string_view rest) {
        std::array<float, 7> n{};
        const std::size_t count = numbers(rest, n);
        if (count < 3)
            fail(path_, line_, "a vertex needs three coordinates, here are " + std::to_string(count));
        check_vertex_count(soup_.positions.size() + 1, path_, limits_);
        soup_.positions.push_back({n[0], n[1], n[2]});
        const std::size_t color = count == 7 ? 4 : 3;
        if ((count == 4 || count == 7) && n[3] != 1) note(weights_, "w");
        if (count < 6) return;
        soup_.colors.resize(soup_.positions.size() - 1, Vec4f{1, 1, 1, 1});
        soup_.colors.push_back(display_to_linear({n[color], n[color + 1], n[color + 2], 1}));
    }

    void texture_vertex(std::string_view rest) {
        std::array<float, 7> n{};
        if (numbers(rest, n) < 1) fail(path_, line_, "a texture vertex needs a coordinate");
        uvs_.push_back({n[0], n[1]});
    }

    void normal(std::string_view rest) {
        std::array<float, 7> n{};
        if (numbers(rest, n) < 3) fail(path_, line_, "a normal needs three components");
        soup_.normals.push_back({n[0], n[1], n[2]});
    }

    void face(std::string_view rest) {
        std::uint32_t count = 0;
        for (auto token = cut_token(rest); !token.empty(); token = cut_token(rest), ++count)
            soup_.corners.push_back(corner(token));
        if (count < 3)
            fail(path_, line_, "a face needs at least three vertices, here are " + std::to_string(count));
        if (nodes_ != nullptr) nodes_->add_polygon(soup_);
        add_polygon(soup_, {count, material_}, path_, limits_);
        lines_.push_back(line_);
    }

    // "v", "v/vt", "v//vn" or "v/vt/vn"; an index may be left out after its slash.
    PolygonCorner corner(std::string_view token) {
        const std::string_view whole = token;
        std::array<std::string_view, 3> fields{};
        for (std::size_t i = 0;; ++i) {
            const std::size_t slash = token.find('/');
            fields[i] = token.substr(0, slash);
            if (slash == std::string_view::npos) break;
            token.remove_prefix(slash + 1);
            if (i == 2) fail(path_, line_, quote(whole) + " has more than three indices");
        }
        if (fields[0].empty()) fail(path_, line_, quote(whole) + " is no vertex of a face");
        PolygonCorner result;
        result.position = index(fields[0], soup_.positions.size(), "vertex");
        if (!fields[1].empty()) result.uv = index(fields[1], uvs_.size(), "texture vertex");
        if (!fields[2].empty()) result.normal = index(fields[2], soup_.normals.size(), "normal");
        return result;
    }

    // From 1, or from -1 backwards. Whether an absolute one exists shows at the end of the file.
    std::uint32_t index(std::string_view token, std::size_t so_far, const char* what) const {
        const auto value = parse_integer(token);
        if (!value) fail(path_, line_, quote(token) + " is not the index of a " + what);
        if (*value > 0 && *value < std::int64_t{no_index}) return std::uint32_t(*value - 1);
        if (*value < 0 && *value >= -std::int64_t(so_far))
            return std::uint32_t(std::int64_t(so_far) + *value);
        if (*value == 0)
            fail(path_, line_, std::string("the ") + what + " index 0 is out of range; indices count from 1");
        fail_range(line_, *value, so_far, what);
    }

    [[noreturn]] void fail_range(std::size_t line, std::int64_t value, std::size_t count,
                                 const char* what) const {
        fail(path_, line,
             std::string("the ") + what + " index " + std::to_string(value) + " is out of range; there are " +
                 std::to_string(count));
    }

    // Exporters that are told to leave out normals or texture coordinates can leave their indices in.
    void drop_absent_attributes() {
        const auto drop = [&](bool absent, std::uint32_t PolygonCorner::*index, const char* what) {
            bool dropped = false;
            for (PolygonCorner& corner : soup_.corners) {
                if (!absent || corner.*index == no_index) continue;
                corner.*index = no_index;
                dropped = true;
            }
            if (dropped) warn(report_, std::string("Faces refer to ") + what + ", but the file has none.");
        };
        drop(uvs_.empty(), &PolygonCorner::uv, "texture vertices");
        drop(soup_.normals.empty(), &PolygonCorner::normal, "normals");
    }

    void check_indices() const {
        std::size_t c = 0;
        for (std::size_t p = 0; p < soup_.polygons.size(); ++p) {
            for (const std::size_t end = c + soup_.polygons[p].corners; c < end; ++c) {
                const PolygonCorner& corner = soup_.corners[c];
                const auto check = [&](std::uint32_t i, std::size_t count, const char* what) {
                    if (i != no_index && i >= count) fail_range(lines_[p], std::int64_t{i} + 1, count, what);
                };
                check(corner.position, soup_.positions.size(), "vertex");
                check(corner.uv, uvs_.size(), "texture vertex");
                check(corner.normal, soup_.normals.size(), "normal");
            }
        }
    }

    void use_material(std::string_view name) {
        const auto [it, added] = material_index_.try_emplace(std::string(name), std::uint32_t(names_.size()));
        if (added) names_.push_back(it->first);
        material_ = it->second;
    }

    // Materials in the order of their first face, only those that faces use; texture coordinates as the
    // material's map wants them.
    void make_materials() {
        std::vector<std::uint32_t> used(names_.size(), no_index);
        std::vector<ObjMaterial> materials;
        // Texture coordinates of materials with a map transform are made once for each material and vt.
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> transformed;
        soup_.uvs.reserve(uvs_.size());
        for (const Vec2f& uv : uvs_) soup_.uvs.push_back({uv.x, 1 - uv.y});
        std::size_t c = 0;
        for (Polygon& polygon : soup_.polygons) {
            const std::uint32_t name = polygon.material;
            if (used[name] == no_index) {
                used[name] = std::uint32_t(materials.size());
                materials.push_back(materials_.make(names_[name], soup_.textures));
            }
            polygon.material = used[name];
            const ObjMaterial& material = materials[polygon.material];
            const bool plain = material.uv_scale == Vec2f{1, 1} && material.uv_offset == Vec2f{};
            for (const std::size_t end = c + polygon.corners; c < end; ++c) {
                PolygonCorner& corner = soup_.corners[c];
                if (!soup_.colors.empty()) corner.color = corner.position;
                if (plain || corner.uv == no_index) continue;
                const Vec2f uv = uvs_[corner.uv];
                const auto [it, added] =
                    transformed.try_emplace({polygon.material, corner.uv}, std::uint32_t(soup_.uvs.size()));
                if (added)
                    soup_.uvs.push_back({uv.x * material.uv_scale.x + material.uv_offset.x,
                                         1 - (uv.y * material.uv_scale.y + material.uv_offset.y)});
                corner.uv = it->second;
            }
        }
        soup_.colors.resize(soup_.colors.empty() ? 0 : soup_.positions.size(), Vec4f{1, 1, 1, 1});
        for (ObjMaterial& material : materials) soup_.materials.push_back(std::move(material.material));
        if (soup_.materials.empty()) soup_.materials.emplace_back();
    }

    // What is passed over is reported once a kind, with the first place.
    struct Leftovers {
        std::size_t count = 0, line = 0;
        std::string first;
    };
    void note(Leftovers& kind, std::string_view word) const {
        if (kind.count++ == 0) {
            kind.line = line_;
            kind.first = quote(word);
        }
    }
    void warn_of(const Leftovers& kind, const std::string& what) const {
        if (kind.count > 0)
            warn(report_,
                 "line " + std::to_string(kind.line) + ": " + kind.first + what +
                     (kind.count > 1 ? " (" + std::to_string(kind.count) + " such statements)." : "."));
    }
    void warn_of_leftovers() const {
        if (soup_.polygons.empty() && unknown_.count > 0)
            fail(path_, unknown_.line,
                 "unknown statement " + unknown_.first + ", and the file holds no faces: nothing to bake");
        warn_of(unknown_, " is an unknown statement and was passed over");
        warn_of(free_form_, " belongs to a free-form curve or surface, which is not read");
        warn_of(unreadable_, " is not a number and counts as undefined");
        warn_of(weights_, " of a vertex is not 1; the weight is ignored");
    }

    const std::filesystem::path& path_;
    const Limits& limits_;
    Report& report_;
    ObjMaterials materials_;
    ObjNodes* nodes_;
    PolygonSoup soup_;
    std::vector<Vec2f> uvs_;             // as in the file
    std::vector<std::size_t> lines_;     // of the polygons
    std::vector<std::string> names_{""}; // of materials, in order of the first usemtl
    std::map<std::string, std::uint32_t> material_index_{{"", 0}};
    std::uint32_t material_ = 0;
    std::size_t line_ = 0;
    Leftovers unknown_, free_form_, unreadable_, weights_;
};

} // namespace

Result read_obj(const Asset& asset, const Limits& limits) {
    Result result;
    result.report.format = "OBJ";
    PolygonSoup soup = ObjParser(asset, limits, result.report, nullptr).parse(as_text(asset.file.bytes));
    result.model = to_model(std::move(soup), asset.path, limits, result.report);
    return result;
}

SceneResult read_obj_scene(const Asset& asset, const Limits& limits) {
    SceneResult result;
    result.report.format = "OBJ";
    ObjNodes nodes(asset.path);
    PolygonSoup soup = ObjParser(asset, limits, result.report, &nodes).parse(as_text(asset.file.bytes));
    result.scene.model =
        to_model(std::move(soup), asset.path, limits, result.report, &result.scene.triangle_nodes);
    result.scene.nodes = nodes.take();
    return result;
}

} // namespace spa::import
