// SPDX-License-Identifier: Apache-2.0
#include "import_fuzzing.h"

#include "../../formats/import/linear_picture.h"
#include "../../formats/import/open_file.h"
#include "../../formats/import/readers.h"
#include "../../formats/import/texture.h"
#include "../../libspa/core/error.h"
#include "../../libspa/mesh/pose.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>

#include <tbb/global_control.h>
#include <unistd.h>

namespace spa::test {
namespace {

namespace fs = std::filesystem;
using import::Asset;

spa::import::Limits low_limits() {
    import::Limits limits;
    limits.file_bytes = 1U << 20U;
    limits.total_bytes = 1U << 22U;
    limits.model_bytes = 1U << 24U;
    limits.vertices = limits.triangles = limits.texture_pixels = 1U << 16U;
    limits.node_depth = 32;
    return limits;
}

void require(bool condition, const char* what) {
    if (condition) return;
    std::fprintf(stderr, "%s\n", what);
    std::abort();
}

// The files that an asset may refer to, in memory where the system has a folder for that.
class Folder {
public:
    Folder() {
        const fs::path memory = "/dev/shm";
        std::string name =
            (fs::is_directory(memory) ? memory : fs::temp_directory_path()) / "spa_fuzz_XXXXXX";
        require(::mkdtemp(name.data()) != nullptr, "no folder can be made");
        path_ = import::real_folder(name);
        std::string floats;
        for (const float value :
             {0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 1.F, 1.F, 1.F, 1.F, 1.F}) {
            std::array<char, sizeof value> bytes{};
            std::memcpy(bytes.data(), &value, sizeof value);
            floats.append(bytes.data(), bytes.size());
        }
        write("a.bin", floats + std::string("\0\1\2\0\2\3\0\0", 8) + std::string(440, '\1'));
        write("a.png", std::string(one_pixel_png));
        write("a.tga", std::string("\0\0\2\0\0\0\0\0\0\0\0\0\1\0\1\0\x20\x28\1\2\3\4", 22));
    }
    ~Folder() {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;

    [[nodiscard]] const fs::path& path() const { return path_; }

    void write(const char* name, std::string_view content) const {
        std::ofstream file(path_ / name, std::ios::binary);
        file.write(content.data(), std::streamsize(content.size()));
    }

private:
    static constexpr std::string_view one_pixel_png{
        "\x89\x50\x4E\x47\x0D\x0A\x1A\x0A\x00\x00\x00\x0D\x49\x48\x44\x52\x00\x00"
        "\x00\x01\x00\x00\x00\x01\x08\x02\x00\x00\x00\x90\x77\x53\xDE\x00\x00\x00"
        "\x0C\x49\x44\x41\x54\x78\xDA\x63\xF8\xDF\xE0\x00\x00\x04\x41\x01\xC0\x32"
        "\x2C\x3E\x3D\x00\x00\x00\x00\x49\x45\x4E\x44\xAE\x42\x60\x82",
        69};
    fs::path path_;
};

const Folder& folder() {
    static const Folder made;
    // Inputs are small: more threads would only wait for each other.
    static const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
    return made;
}

bool is_finite(const Vec4f& v) { return std::isfinite(v.x + v.y + v.z + v.w); }

void check_texture(const Texture& texture) {
    require(!texture.mips.empty(), "a texture without an image");
    for (const Image& image : texture.mips)
        require(image.width > 0 && image.height > 0 &&
                    image.pixels.size() == std::size_t(image.width) * image.height,
                "an image of another size than its pixels");
    require(texture.mips.back().pixels.size() == 1, "the smallest image is not a pixel");
}

// As import.h and model.h promise.
void check_model(const Model& model) {
    const std::size_t vertices = model.positions.size();
    require(!model.triangles.empty() && !model.materials.empty(), "nothing in it");
    require(model.normals.size() == vertices, "vertices without normals");
    require(model.uvs.empty() || model.uvs.size() == vertices, "uvs of some vertices");
    require(model.colors.empty() || model.colors.size() == vertices, "colours of some vertices");
    require(model.triangle_materials.size() == model.triangles.size(), "triangles without material");
    for (const Vec3f& position : model.positions)
        require(spa::is_finite(position), "a position is not finite");
    for (const Vec3f& normal : model.normals)
        require(std::abs(length(normal) - 1) < 1e-4F, "a normal is not of unit length");
    for (const Vec2f& uv : model.uvs) require(std::isfinite(uv.x + uv.y), "a uv is not finite");
    for (const Vec4f& color : model.colors) require(is_finite(color), "a colour is not finite");
    for (const Triangle& triangle : model.triangles)
        for (const std::uint32_t vertex : triangle.vertex) require(vertex < vertices, "no such vertex");
    for (const std::uint32_t material : model.triangle_materials)
        require(material < model.materials.size(), "no such material");
    for (const Material& material : model.materials) {
        require(material.texture == no_index || material.texture < model.textures.size(), "no such texture");
        require(is_finite(material.base_color), "a base colour is not finite");
    }
    for (const Texture& texture : model.textures) check_texture(texture);
}

void check_scene(const Scene& scene) {
    check_model(scene.model);
    require(scene.triangle_nodes.size() == scene.model.triangles.size(), "triangles without node");
    for (const std::uint32_t node : scene.triangle_nodes) require(node < scene.nodes.size(), "no such node");
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        require(scene.nodes[i].parent == no_index || scene.nodes[i].parent < i, "a child before its parent");
        require(is_finite(scene.nodes[i].to_world), "a transform is not finite");
    }
    for (const Camera& camera : scene.cameras)
        require(camera.vertical_fov > 0 && camera.vertical_fov < 3.15 && is_finite(camera.to_world),
                "a camera outside its ranges");
    for (const Light& light : scene.lights)
        require(spa::is_finite(light.position) && std::abs(length(light.direction) - 1) < 1e-6 &&
                    spa::is_finite(light.intensity) && light.intensity.x >= 0 && light.intensity.y >= 0 &&
                    light.intensity.z >= 0,
                "a light outside its ranges");
}

void check_curve(const Curve& curve, std::size_t width) {
    const std::size_t per_key = curve.interpolation == Interpolation::cubic_spline ? 3 : 1;
    require(curve.values.size() == curve.times.size() * per_key * width, "a curve of another size");
    for (std::size_t i = 0; i < curve.times.size(); ++i)
        require(std::isfinite(curve.times[i]) && (i == 0 || curve.times[i - 1] < curve.times[i]),
                "a time that does not grow");
    for (const float value : curve.values) require(std::isfinite(value), "a value is not finite");
}

// As rig.h promises; and every animation can be played.
void check_rig(const Scene& scene) {
    const Rig& rig = scene.rig;
    const std::size_t vertices = scene.model.positions.size();
    require(!rig.empty() && rig.positions.size() == vertices && rig.normals.size() == vertices &&
                rig.first.size() == vertices + 1 && rig.first.front() == 0 &&
                rig.first.back() == rig.influences.size(),
            "a rig of another size");
    for (std::size_t v = 0; v < vertices; ++v)
        require(rig.first[v] < rig.first[v + 1], "a vertex without influence");
    for (const Influence& influence : rig.influences)
        require(influence.bone < rig.bones.size() && std::isfinite(influence.weight) && influence.weight != 0,
                "an influence outside its ranges");
    for (const Bone& bone : rig.bones) require(bone.node < scene.nodes.size(), "a bone without node");
    for (const Animation& animation : rig.animations) {
        for (const Track& track : animation.tracks) {
            require(track.node < scene.nodes.size(), "a track without node");
            check_curve(track.translations, 3);
            check_curve(track.rotations, 4);
            check_curve(track.scales, 3);
        }
        Model model = scene.model;
        pose_vertices(scene, pose_nodes(scene, animation, animation.seconds / 2), model);
    }
}

void check_report(const import::Report& report) {
    require(!report.format.empty() && !report.files.empty(), "a report without sources");
    require(report.warnings.size() <= import::max_warnings + 1, "too many warnings");
}

void check_error(const Error& error, const fs::path& path) {
    require(error.code() == ExitCode::invalid_data || error.code() == ExitCode::unsupported ||
                error.code() == ExitCode::input_output,
            "an error of another kind");
    require(std::string_view(error.what()).starts_with(path.string()), "a message without the path");
}

// Lengths and checksums that no mutation gets right: of the whole file and, if its JSON chunk fits, of the
// chunk behind it.
void repair_glb(std::vector<std::byte>& bytes) {
    const auto store = [&](std::size_t at, std::size_t value) {
        for (std::size_t i = 0; i < 4; ++i) bytes[at + i] = std::byte(value >> (8 * i) & 0xFFU);
    };
    const auto load = [&](std::size_t at) {
        std::size_t value = 0;
        for (std::size_t i = 4; i-- > 0;) value = value << 8U | std::to_integer<std::size_t>(bytes[at + i]);
        return value;
    };
    store(4, 2);
    store(8, bytes.size());
    const std::size_t behind = 20 + load(12);
    if (behind > bytes.size())
        store(12, bytes.size() - 20);
    else if (bytes.size() - behind >= 8)
        store(behind, bytes.size() - behind - 8);
}

void read(const Asset& asset) {
    const import::Limits limits = low_limits();
    std::size_t triangles = 0;
    try {
        const import::Result result = import::read_asset(asset, limits);
        check_model(result.model);
        check_report(result.report);
        triangles = result.model.triangles.size();
        require(result.model.positions.size() <= limits.vertices && triangles <= limits.triangles,
                "too large");
    } catch (const Error& error) {
        check_error(error, asset.path);
    }
    try {
        const import::SceneResult result = import::read_asset_scene(asset, limits, {});
        check_scene(result.scene);
        check_report(result.report);
        require(result.scene.model.triangles.size() == triangles, "the scene has another model");
    } catch (const Error& error) {
        check_error(error, asset.path);
    }
    try {
        const import::SceneResult result = import::read_asset_scene(asset, limits, {.rig = true});
        check_scene(result.scene);
        check_rig(result.scene);
        require(result.scene.model.triangles.size() == triangles, "the rig has another model");
    } catch (const Error& error) {
        check_error(error, asset.path);
    }
}

} // namespace

void fuzz_asset(std::string_view name, std::span<const std::byte> input) {
    Asset asset{folder().path() / name, {}, folder().path()};
    std::vector<std::byte>& bytes = asset.file.bytes;
    bytes.assign(input.begin(), input.end());
    if (name.ends_with(".obj")) {
        const auto zero = std::find(bytes.begin(), bytes.end(), std::byte{0});
        if (zero != bytes.end()) {
            const auto text = std::span(bytes).subspan(std::size_t(zero - bytes.begin()) + 1);
            folder().write("a.mtl", {reinterpret_cast<const char*>(text.data()), text.size()});
        }
        bytes.erase(zero, bytes.end());
    }
    read(asset);
    if (bytes.size() < 20 || std::memcmp(bytes.data(), "glTF", 4) != 0) return;
    repair_glb(bytes);
    read(asset);
}

void fuzz_picture(std::span<const std::byte> input) {
    if (input.empty()) return;
    const auto kind = std::to_integer<unsigned>(input[0]);
    const std::span<const std::byte> bytes = input.subspan(1);
    const char* const name = (kind & 1U) != 0 ? "picture.tga" : "picture.png";
    try {
        if ((kind & 2U) == 0) {
            check_texture(import::read_texture(bytes, name, low_limits()));
            return;
        }
        constexpr std::array<std::string_view, 2> layers{"direct", "indirect"};
        folder().write(name, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
        const import::LinearPicture picture =
            import::read_picture(folder().path() / name, layers, low_limits());
        for (const import::PictureLayer& layer : picture.layers)
            require(layer.pixels.size() == std::size_t(picture.width) * picture.height,
                    "a layer of another size than the picture");
    } catch (const Error& error) {
        check_error(error, (kind & 2U) == 0 ? fs::path(name) : folder().path() / name);
    }
}

} // namespace spa::test
