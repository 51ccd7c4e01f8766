// SPDX-License-Identifier: Apache-2.0
// From the statements of a material library to the materials and textures of a Model.
#pragma once

#include "any_case.h"
#include "import.h"
#include "mtl.h"
#include "polygon_soup.h"
#include "source_file.h"
#include "texture.h"

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace spa::import {

struct ObjMaterial {
    Material material;
    // For texture coordinates as the OBJ file has them (v upwards): uv * uv_scale + uv_offset.
    Vec2f uv_scale{1, 1}, uv_offset{0, 0};
};

// The material libraries of one OBJ file and the textures made for it.
//
// How a material library (there is no standard for it) becomes a base colour:
// - Kd and vertex colours are display values, as modellers pick them: sRGB in [0,1], made linear.
// - Base colour = Kd times map_Kd. A black Kd beside a map_Kd counts as white: exporters leave Kd at 0 when a
//   texture replaces it, and nobody paints a texture to see none of it.
// - Opacity = d, or 1 - Tr if there is no d; below 1 the material blends. A value that would make all of the
//   material invisible is taken as opaque when it comes from Tr (MeshLab and others write the opacity there)
//   or stands beside a map_d (the factor that the map replaces).
// - map_d gives the texture's alpha: its alpha channel if any of it is not opaque, else its luma. If its size
//   differs from map_Kd's, the smaller one is enlarged to the larger width and height by nearest texel. The
//   material blends, as it does when map_Kd itself has an alpha channel that is not opaque.
// - A texture that is missing is a warning, and the material goes without; one that cannot be decoded is an
//   error.
class ObjMaterials {
public:
    ObjMaterials(const Asset& asset, const Limits& limits, Report& report)
        : asset_(asset), report_(report), references_(asset, limits, report), budget_(limits),
          any_case_(asset.path.parent_path()) {}

    // The rest of a mtllib statement: one file name with or without blanks, or several. The first material of
    // a name counts. A missing library is a warning. Throws Error for a reference that leaves the folder and
    // for more than max_materials.
    void read_libraries(std::string_view statement, std::size_t line);

    // The material of this name, white with a warning if no library has it. Its texture is appended to
    // `textures` unless an earlier material had the same. "" is the material of faces before any usemtl:
    // white.
    ObjMaterial make(const std::string& name, std::vector<Texture>& textures);

private:
    struct Found {
        MtlMaterial material;
        std::string library; // name relative to the asset's folder
    };
    // A map_Kd, a map_d or both, as one texture.
    struct MadeTexture {
        std::uint32_t index = no_index;
        bool blends = false;
    };
    // A file that was referred to, and the name by which it was found.
    struct FoundFile {
        std::string name;
        FileContent content;
    };
    std::optional<FoundFile> read(std::string_view reference);
    bool read_library(std::string_view reference);
    // A map of a material; nothing, with a warning, if it has none or its file is missing.
    std::optional<Texture> load(const std::optional<MtlMap>& map, const Found& found);
    // Of a map_Kd and a map_d, of which one may be missing but not both.
    Texture combine(std::optional<Texture> color, const std::optional<Texture>& dissolve);
    MadeTexture make_texture(const Found& found, std::vector<Texture>& textures);

    const Asset& asset_;
    Report& report_;
    References references_;
    TextureBudget budget_;
    AnyCase any_case_;
    std::map<std::string, bool, std::less<>> libraries_; // whether they are there, by reference
    std::map<std::string, Found> materials_;
    std::map<std::pair<std::string, std::string>, MadeTexture> made_; // by the files of map_Kd and map_d
};

} // namespace spa::import
