// SPDX-License-Identifier: Apache-2.0
// PLY: ascii and both binary formats, any scalar and list types, elements and properties in any order, what
// is unknown skipped. A reader of our own, because OpenMesh 9.0's misreads a file whose end_header ends with
// CRLF and one with texture coordinates a face (fuze.ply), and does not say where an error is.
//
// Colours are display values: integers up to the greatest of their type, floats in [0,1]; sRGB, made linear.
// Vertex colours win over face colours, a texture that loads over both: writers give them as alternatives.
// Texture coordinates have v upwards. The material blends if a colour's alpha is below 1, unless all are 0.
#include "readers.h"

#include "../../libspa/core/error.h"
#include "../../libspa/mesh/weld.h"
#include "ply_data.h"
#include "ply_header.h"
#include "polygon_soup.h"
#include "source_file.h"
#include "text.h"
#include "texture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <optional>

namespace spa::import {
namespace {

// The float nearest to a double; beyond the range an infinity (a plain conversion is undefined there).
float to_float(double value) {
    constexpr double most = double(std::numeric_limits<float>::max());
    if (value > most) return std::numeric_limits<float>::infinity();
    if (value < -most) return -std::numeric_limits<float>::infinity();
    return float(value);
}

const PlyProperty* find_property(const PlyElement& element, std::initializer_list<std::string_view> names) {
    for (const std::string_view name : names) {
        for (const PlyProperty& property : element.properties) {
            if (property.name == name) return &property;
        }
    }
    return nullptr;
}

// The scalar properties of one row: where to find them, and the last values read.
struct Row {
    const PlyElement& element;
    std::vector<double> values{std::vector<double>(element.properties.size())};

    [[nodiscard]] std::optional<std::size_t> find(std::initializer_list<std::string_view> names) const {
        const PlyProperty* property = find_property(element, names);
        if (property == nullptr || property->is_list) return std::nullopt;
        return std::size_t(property - element.properties.data());
    }
    [[nodiscard]] float value(std::size_t property) const { return to_float(values[property]); }
};

// Scalar properties that are one thing together.
template <std::size_t N>
using Group = std::optional<std::array<std::size_t, N>>;

struct ColorProperties {
    Group<3> rgb;
    std::optional<std::size_t> alpha;
};

float color_value(const Row& row, std::size_t property) {
    const float value = row.value(property);
    switch (row.element.properties[property].type) {
    case PlyType::int8: return value / 127.0F;
    case PlyType::uint8: return value / 255.0F;
    case PlyType::int16: return value / 32767.0F;
    case PlyType::uint16: return value / 65535.0F;
    case PlyType::int32: return value / 2147483647.0F;
    case PlyType::uint32: return value / 4294967295.0F;
    default: return value;
    }
}

Vec4f read_color(const Row& row, const ColorProperties& color) {
    const auto& rgb = *color.rgb;
    return display_to_linear({color_value(row, rgb[0]), color_value(row, rgb[1]), color_value(row, rgb[2]),
                              color.alpha ? color_value(row, *color.alpha) : 1.0F});
}

class PlyReader {
public:
    PlyReader(std::string_view text, const Asset& asset, const Limits& limits, Report& report)
        : path_(asset.path), limits_(limits), report_(report), references_(asset, limits, report),
          header_(parse_ply_header(text, path_)), data_(text, header_, path_) {}

    PolygonSoup read() {
        check_elements();
        for (const PlyElement& element : header_.elements) {
            data_.begin(element);
            if (element.name == "vertex")
                read_vertices(element);
            else if (element.name == "face")
                read_faces(element);
            else if (element.name == "tristrips")
                read_strips(element);
            else
                skip_element(element);
        }
        if (!data_.at_end()) warn(report_, "There is more data after the last element; it was passed over.");
        read_textures();
        weld_face_uvs();
        choose_colors();
        return std::move(soup_);
    }

private:
    void check_elements() {
        bool has_faces = false;
        for (const PlyElement& element : header_.elements) {
            if (element.name == "vertex") vertex_count_ = element.count;
            if (element.name != "face" && element.name != "tristrips") continue;
            has_faces = has_faces || element.count > 0;
            const PlyProperty* indices = find_property(element, {"vertex_indices", "vertex_index"});
            if (indices == nullptr || !indices->is_list)
                fail(path_, "the element " + quote(element.name) + " has no list vertex_indices");
        }
        check_vertex_count(vertex_count_, path_, limits_);
        check_vertex_properties();
        if (!has_faces) {
            report_.ignored_primitives = vertex_count_;
            fail(path_, "nothing to bake: the file has no faces" +
                            (vertex_count_ > 0 ? ", only " + std::to_string(vertex_count_) + " points"
                                               : std::string()) +
                            "; give a mesh, not a point cloud");
        }
    }

    void check_vertex_properties() const {
        for (const PlyElement& element : header_.elements) {
            if (element.name != "vertex") continue;
            const Row row{element};
            for (const char* name : {"x", "y", "z"}) {
                if (!row.find({name}))
                    fail(path_, std::string("the vertices have no property '") + name +
                                    "'; a position needs x, y and z");
            }
            for (const char* name : {"nx", "ny", "nz"}) {
                const auto property = row.find({name});
                const PlyType type = property ? element.properties[*property].type : PlyType::float32;
                if (type == PlyType::uint8 || type == PlyType::uint16 || type == PlyType::uint32)
                    fail(path_, std::string("the normal component '") + name +
                                    "' is of an unsigned type and cannot point both ways");
            }
        }
    }

    // All N properties, or nothing, with a warning if only some are there.
    template <std::size_t N>
    Group<N> find_group(const Row& row, const std::array<std::initializer_list<std::string_view>, N>& names) {
        std::array<std::size_t, N> found{};
        std::size_t count = 0;
        for (const auto& candidates : names) {
            if (const auto property = row.find(candidates)) found[count++] = *property;
        }
        if (count == N) return found;
        if (count > 0)
            warn(report_, "The element " + quote(row.element.name) +
                              " has only some of the properties like '" +
                              row.element.properties[found[0]].name + "'; they were passed over.");
        return std::nullopt;
    }

    ColorProperties find_color(const Row& row) {
        return {find_group<3>(row, {{{"red", "r", "diffuse_red"},
                                     {"green", "g", "diffuse_green"},
                                     {"blue", "b", "diffuse_blue"}}}),
                row.find({"alpha", "a", "diffuse_alpha"})};
    }

    void read_vertices(const PlyElement& element) {
        Row row{element};
        const auto position = find_group<3>(row, {{{"x"}, {"y"}, {"z"}}});
        const auto normal = find_group<3>(row, {{{"nx"}, {"ny"}, {"nz"}}});
        const auto uv = find_group<2>(row, {{{"u", "s", "texture_u", "texture_s", "texcoord_u"},
                                             {"v", "t", "texture_v", "texture_t", "texcoord_v"}}});
        const ColorProperties color = find_color(row);
        has_vertex_normals_ = normal.has_value();
        has_vertex_uvs_ = uv.has_value();
        has_vertex_colors_ = color.rgb.has_value();
        // begin() has checked the count against the bytes that are there.
        soup_.positions.reserve(element.count);
        const std::size_t first_uv = soup_.uvs.size();
        const std::size_t first_color = soup_.colors.size();
        for (std::uint64_t i = 0; i < element.count; ++i) {
            read_row(row, nullptr, nullptr);
            const auto& p = *position;
            soup_.positions.push_back({row.value(p[0]), row.value(p[1]), row.value(p[2])});
            if (normal)
                soup_.normals.push_back(
                    {row.value((*normal)[0]), row.value((*normal)[1]), row.value((*normal)[2])});
            if (uv) soup_.uvs.push_back({row.value((*uv)[0]), 1 - row.value((*uv)[1])});
            if (color.rgb) soup_.colors.push_back(read_color(row, color));
        }
        first_vertex_uv_ = std::uint32_t(first_uv);
        first_vertex_color_ = std::uint32_t(first_color);
    }

    // Reads one row; the two lists, if asked for, into list_ and uv_list_.
    void read_row(Row& row, const PlyProperty* list, const PlyProperty* uv_list) {
        data_.begin_row();
        for (std::size_t i = 0; i < row.values.size(); ++i) {
            const PlyProperty& property = row.element.properties[i];
            if (&property == list)
                data_.read_list(property, list_);
            else if (&property == uv_list)
                data_.read_list(property, uv_list_);
            else if (property.is_list)
                data_.skip(property);
            else
                row.values[i] = data_.read(property.type);
        }
    }

    std::uint32_t vertex_index(double value) const {
        if (!(value >= 0 && value < double(vertex_count_) && value == std::floor(value)))
            data_.refuse("the vertex index " + number(value) + " is out of range; there are " +
                         std::to_string(vertex_count_) + " vertices");
        return std::uint32_t(value);
    }

    static std::string number(double value) {
        return std::abs(value) < 1e15 && value == std::floor(value) ? std::to_string(std::int64_t(value))
                                                                    : std::to_string(value);
    }

    void read_faces(const PlyElement& element) {
        Row row{element};
        const PlyProperty* indices = find_property(element, {"vertex_indices", "vertex_index"});
        const PlyProperty* uvs = find_property(element, {"texcoord"});
        if (uvs != nullptr && !uvs->is_list) uvs = nullptr;
        const auto texture = row.find({"texnumber"});
        const ColorProperties color = find_color(row);
        soup_.polygons.reserve(element.count);
        for (std::uint64_t i = 0; i < element.count; ++i) {
            uv_list_.clear();
            read_row(row, indices, uvs);
            if (list_.size() < 3) {
                ++report_.ignored_primitives;
                continue;
            }
            const bool has_uvs = !uv_list_.empty() && uv_list_.size() == 2 * list_.size();
            if (!has_uvs && !uv_list_.empty())
                warn(report_, "A face's texcoord list has not two values a vertex; it was passed over.");
            std::uint32_t face_color = no_index;
            if (color.rgb) {
                face_color = std::uint32_t(soup_.colors.size());
                soup_.colors.push_back(read_color(row, color));
            }
            for (std::size_t k = 0; k < list_.size(); ++k) {
                PolygonCorner corner;
                corner.position = vertex_index(list_[k]);
                corner.color = face_color;
                if (has_uvs) {
                    corner.uv = std::uint32_t(soup_.uvs.size());
                    soup_.uvs.push_back({to_float(uv_list_[2 * k]), 1 - to_float(uv_list_[2 * k + 1])});
                }
                soup_.corners.push_back(corner);
            }
            const double number = texture ? row.values[*texture] : 0;
            const bool known = number >= 0 && number < double(header_.textures.size());
            add_polygon(soup_, {std::uint32_t(list_.size()), known ? std::uint32_t(number) : 0}, path_,
                        limits_);
        }
        if (report_.ignored_primitives > 0)
            warn(report_, "Passed over faces with fewer than three vertices: " +
                              std::to_string(report_.ignored_primitives) + ".");
    }

    // Triangle strips, ended by -1 (Stanford's scans); every other triangle of a strip is reversed.
    void read_strips(const PlyElement& element) {
        Row row{element};
        const PlyProperty* indices = find_property(element, {"vertex_indices", "vertex_index"});
        for (std::uint64_t i = 0; i < element.count; ++i) {
            read_row(row, indices, nullptr);
            std::size_t begin = 0;
            for (std::size_t k = 0; k < list_.size(); ++k) {
                if (list_[k] == -1) {
                    begin = k + 1;
                    continue;
                }
                const std::uint32_t last = vertex_index(list_[k]);
                if (k < begin + 2) continue;
                auto first = std::uint32_t(list_[k - 2]);
                auto second = std::uint32_t(list_[k - 1]);
                if ((k - begin) % 2 == 1) std::swap(first, second);
                for (const std::uint32_t vertex : {first, second, last}) {
                    PolygonCorner corner;
                    corner.position = vertex;
                    soup_.corners.push_back(corner);
                }
                add_polygon(soup_, {3, 0}, path_, limits_);
            }
        }
    }

    void skip_element(const PlyElement& element) {
        // Rows of no values are no data.
        if (element.properties.empty()) return;
        for (std::uint64_t i = 0; i < element.count; ++i) {
            data_.begin_row();
            for (const PlyProperty& property : element.properties) data_.skip(property);
        }
    }

    void read_textures() {
        for (const std::string& name : header_.textures) {
            Material material;
            material.name = name;
            const Reference reference = resolve_reference(path_, name, Encoding::file_name);
            if (const auto content = references_.read(reference)) {
                try {
                    soup_.textures.push_back(budget_.decode(content->bytes, reference.name));
                } catch (const Error& error) {
                    throw Error(error.code(), path_.string() + ": texture " + error.what());
                }
                material.texture = std::uint32_t(soup_.textures.size() - 1);
            } else {
                references_.add_missing(reference.name);
                warn(report_, "The texture " + quote(name) + " is missing; the material goes without it.");
            }
            soup_.materials.push_back(std::move(material));
        }
        if (soup_.materials.empty()) {
            soup_.materials.emplace_back();
            soup_.materials[0].name = "default";
        }
    }

    // Texture coordinates come once a corner; equal ones become one, so that corners can become one vertex.
    void weld_face_uvs() {
        std::vector<Vec3f> points;
        points.reserve(soup_.uvs.size());
        for (const Vec2f& uv : soup_.uvs) points.push_back({uv.x, uv.y, 0});
        const std::vector<std::uint32_t> first = weld_positions(points);
        for (PolygonCorner& corner : soup_.corners) {
            if (corner.uv != no_index) corner.uv = first[corner.uv];
        }
    }

    // Vertex attributes go to the corners here, when all elements are read: faces may come before vertices.
    void choose_colors() {
        const bool has_uvs = has_vertex_uvs_ || !soup_.uvs.empty();
        const bool textured = has_uvs && !soup_.textures.empty();
        if (textured && !soup_.colors.empty())
            warn(report_, "The file has both a texture and colours; the texture is used.");
        for (PolygonCorner& corner : soup_.corners) {
            if (has_vertex_normals_) corner.normal = corner.position;
            if (has_vertex_uvs_ && corner.uv == no_index) corner.uv = first_vertex_uv_ + corner.position;
            if (has_vertex_colors_) corner.color = first_vertex_color_ + corner.position;
            if (textured) corner.color = no_index;
        }
        if (textured) soup_.colors.clear();
        if (soup_.colors.empty()) return;
        const auto invisible = [](const Vec4f& color) { return color.w == 0; };
        const auto translucent = [](const Vec4f& color) { return color.w < 1; };
        if (std::all_of(soup_.colors.begin(), soup_.colors.end(), invisible)) {
            warn(report_, "The alpha of all colours is 0; it is taken as 1.");
            for (Vec4f& color : soup_.colors) color.w = 1;
        }
        if (std::any_of(soup_.colors.begin(), soup_.colors.end(), translucent)) {
            for (Material& material : soup_.materials) material.alpha_mode = AlphaMode::blend;
        }
    }

    const std::filesystem::path& path_;
    const Limits& limits_;
    Report& report_;
    References references_;
    TextureBudget budget_{limits_};
    PlyHeader header_;
    PlyData data_;
    PolygonSoup soup_;
    std::uint64_t vertex_count_ = 0;
    bool has_vertex_normals_ = false, has_vertex_uvs_ = false, has_vertex_colors_ = false;
    std::uint32_t first_vertex_uv_ = 0, first_vertex_color_ = 0;
    std::vector<double> list_, uv_list_; // of the last row
};

} // namespace

Result read_ply(const Asset& asset, const Limits& limits) {
    Result result;
    result.report.format = "PLY";
    PolygonSoup soup = PlyReader(as_text(asset.file.bytes), asset, limits, result.report).read();
    result.model = to_model(std::move(soup), asset.path, limits, result.report);
    return result;
}

} // namespace spa::import
