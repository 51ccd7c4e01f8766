// SPDX-License-Identifier: Apache-2.0
// read_gltf: 1. split the container, 2. check the document, 3. read the buffers, 4. let tinygltf build its
// model of the rest, 5. flatten the scene, 6. append every primitive of every instance. read_gltf_scene reads
// the cameras and lights after 2 and adds them and the nodes after 6; a rig grows with 6, its animations are
// read at the end.
//
// tinygltf gets the document without buffers, images and what we read ourselves or have no use for: their
// bytes stay where they were read to, nothing is copied, and no reference is opened but by Buffers and
// Images.
#include "gltf_animation.h"
#include "gltf_check.h"
#include "gltf_check_values.h"
#include "gltf_container.h"
#include "gltf_primitive.h"
#include "gltf_scene_parts.h"
#include "readers.h"

#include <limits>
#include <optional>

namespace spa::import {
namespace gltf {
namespace {

Json parse_json(std::string_view text, const Context& context) {
    try {
        return Json::parse(text);
    } catch (const Json::exception& error) { // also numbers out of range
        // "[json.exception.parse_error.101] parse error at line 1, column 2: ..."
        const std::string_view message = error.what();
        const std::size_t end = message.find("] ");
        fail(context, "JSON", std::string(end == std::string_view::npos ? message : message.substr(end + 2)));
    }
}

void check_document(Json& document, const Context& context) {
    check_counts(document, context);
    check_schema(document, context);
    check_asset(document, context);
    check_buffer_views(document, context);
    check_accessors(document, context);
    check_images(document, context);
    check_meshes(document, context);
    check_skins(document, context);
    check_nodes(document, context);
    check_scenes(document, context);
    check_animations(document, context);
}

// tinygltf's model of what is left in the document. Takes out what tinygltf would open, decode or stumble
// over: indices of Draco primitives have no buffer view, which it refuses.
tinygltf::Model build_model(Json& document, const Context& context) {
    for (const char* key : {"buffers", "cameras", "extensions"}) document.erase(key);
    Json animations = std::move(document["animations"]);
    document.erase("animations");
    if (document.contains("meshes"))
        for (Json& mesh : document["meshes"])
            for (Json& primitive : mesh["primitives"])
                if (member_of(primitive, "extensions").contains("KHR_draco_mesh_compression"))
                    primitive.erase("indices");

    remove_unread(document);
    const std::string text = document.dump();
    document = Json::object();
    if (!animations.is_null()) document["animations"] = std::move(animations);
    if (text.size() > std::numeric_limits<unsigned>::max()) fail(context, "JSON", "is longer than 4 GiB");
    tinygltf::TinyGLTF loader;
    loader.SetImageLoader([](tinygltf::Image*, int, std::string*, std::string*, int, int,
                             const unsigned char*, int, void*) { return true; },
                          nullptr);
    tinygltf::Model model;
    std::string errors, warnings;
    if (!loader.LoadASCIIFromString(&model, &errors, &warnings, text.data(),
                                    static_cast<unsigned>(text.size()), "", tinygltf::NO_REQUIRE))
        fail(context, "", errors);
    return model;
}

// How much a few bytes of JSON may make us read again and again, beyond what ends up in the model.
constexpr std::uint64_t max_primitives = std::uint64_t{1} << 22U;
constexpr std::uint64_t max_reads_per_vertex = 16; // of the limit of vertices

std::uint64_t bytes_of(const Size& size, bool rig) {
    std::uint64_t bytes = size.vertices * vertex_bytes + size.triangles * triangle_bytes;
    if (rig) bytes += size.vertices * rig_vertex_bytes + size.influences * influence_bytes;
    return bytes;
}

// Holds the flattened scene against the limits before anything is allocated for it.
Size total_size(const tinygltf::Model& model, const std::vector<Instance>& instances, bool rig,
                const Context& context) {
    Size total;
    std::uint64_t primitives = 0;
    for (const Instance& instance : instances)
        for (const tinygltf::Primitive& primitive :
             model.meshes[static_cast<std::size_t>(model.nodes[instance.node].mesh)].primitives) {
            if (++primitives > max_primitives)
                fail(context, "",
                     "the scene draws more than " + std::to_string(max_primitives) + " primitives");
            if (!is_drawn(primitive)) continue;
            const Size size = size_of(model, primitive);
            total.reads += size.reads;
            if (total.reads / max_reads_per_vertex > context.limits.vertices)
                fail(context, "", "the scene reads morph targets or sparse accessors too often");
            total.vertices += size.vertices;
            total.triangles += size.triangles;
            total.influences += size.influences;
            if (total.vertices > context.limits.vertices)
                fail(context, "",
                     "the scene has more vertices than the limit of " +
                         std::to_string(context.limits.vertices));
            if (bytes_of(total, rig) > context.limits.model_bytes)
                fail(context, "",
                     "the scene makes a model larger than the limit of " +
                         std::to_string(context.limits.model_bytes) + " bytes");
            if (rig && total.influences > no_index)
                fail(context, "", "the scene has more weights of joints than can be numbered");
            if (total.triangles > context.limits.triangles)
                fail(context, "",
                     "the scene has more triangles than the limit of " +
                         std::to_string(context.limits.triangles));
        }
    return total;
}

std::string nothing_to_bake(const tinygltf::Model& model, const std::vector<Instance>& instances,
                            const Report& report) {
    if (model.meshes.empty()) return "the file has no meshes";
    if (instances.empty()) return "no node of the scene has a mesh";
    std::string why = "no triangle is left";
    if (report.ignored_primitives != 0)
        why += ", " + std::to_string(report.ignored_primitives) + " primitives are points or lines";
    if (report.dropped_degenerate != 0)
        why += ", " + std::to_string(report.dropped_degenerate) + " triangles have no area";
    if (report.dropped_non_finite != 0)
        why +=
            ", " + std::to_string(report.dropped_non_finite) + " triangles have corners that are not finite";
    return why;
}

// What is read; `scene` is null where only the model is wanted.
struct Target {
    Model& model;
    Scene* scene = nullptr;
    bool rig = false;
};

// `document`: the animations.
void assemble(const Json& document, const tinygltf::Model& model, Buffers& buffers, Images& images,
              const Context& context, const Target& target, const SceneParts& parts) {
    Model& out = target.model;
    std::vector<Place> places;
    const std::vector<Instance> instances =
        flatten_scene(model, buffers, context, target.scene != nullptr ? &places : nullptr);
    const Size total = total_size(model, instances, target.rig, context);
    std::vector<bool> used(model.materials.size());
    bool any_colors = false;
    for (const Instance& instance : instances)
        for (const tinygltf::Primitive& primitive :
             model.meshes[static_cast<std::size_t>(model.nodes[instance.node].mesh)].primitives) {
            if (!is_drawn(primitive)) continue;
            if (primitive.material >= 0) used[static_cast<std::size_t>(primitive.material)] = true;
            any_colors = any_colors || primitive.attributes.count("COLOR_0") != 0;
        }
    const std::uint64_t mesh_bytes = bytes_of(total, target.rig);
    images.reserve(mesh_bytes);
    Materials materials(model, used, images, out, context);
    out.positions.reserve(total.vertices);
    out.normals.reserve(total.vertices);
    out.triangles.reserve(total.triangles);
    out.triangle_materials.reserve(total.triangles);
    if (!out.textures.empty()) out.uvs.reserve(total.vertices);
    if (any_colors) out.colors.reserve(total.vertices);

    std::optional<RigBuilder> rig;
    if (target.rig) {
        rig.emplace(model, buffers, target.scene->rig, context);
        target.scene->rig.positions.reserve(total.vertices);
        target.scene->rig.normals.reserve(total.vertices);
        target.scene->rig.first.reserve(total.vertices + 1);
        target.scene->rig.influences.reserve(total.influences);
    }
    Assembly assembly{
        model, buffers, materials, out, context, global_transforms(model), {}, {}, rig ? &*rig : nullptr};
    for (const Instance& instance : instances) {
        const tinygltf::Mesh& mesh = model.meshes[static_cast<std::size_t>(model.nodes[instance.node].mesh)];
        for (std::size_t i = 0; i < mesh.primitives.size(); ++i) {
            if (is_drawn(mesh.primitives[i]))
                append_primitive(assembly, instance, i);
            else
                ++context.report.ignored_primitives;
        }
        if (target.scene != nullptr)
            target.scene->triangle_nodes.resize(out.triangles.size(), instance.place);
    }
    if (context.report.dropped_non_finite != 0)
        warn(context, "",
             std::to_string(context.report.dropped_non_finite) +
                 " triangles have corners that are not finite and are left out");
    if (out.triangles.empty())
        fail(context, "", "nothing to bake: " + nothing_to_bake(model, instances, context.report));
    if (!out.uvs.empty()) out.uvs.resize(out.positions.size());
    if (!out.colors.empty()) out.colors.resize(out.positions.size(), {1, 1, 1, 1});
    if (out.materials.empty()) (void)materials.default_material();
    if (rig) {
        rig->finish(places);
        target.scene->rig.animations = read_animations(document, model, places, buffers,
                                                       context.limits.model_bytes - mesh_bytes, context);
    }
    if (target.scene != nullptr) fill_scene(model, places, parts, *target.scene, context);
}

void read(const Context& context, const Target& target) {
    const Container container = split_container(context.asset.file.bytes, context);
    context.report.format = container.binary ? "GLB" : "glTF";
    Json document = parse_json(container.json, context);
    check_document(document, context);
    SceneParts parts;
    if (target.scene != nullptr) parts = read_scene_parts(document, context);
    Buffers buffers(document, container, context);
    Images images(document, buffers, context);
    const tinygltf::Model model = build_model(document, context);
    std::optional<Error> error;
    try {
        assemble(document, model, buffers, images, context, target, parts);
    } catch (const Error& caught) {
        error = caught;
    }
    // After the assembly: its errors matter more than these warnings, which help to explain them.
    CheckBudget budget(context);
    check_bounds(model, buffers, budget, context);
    check_colors(model, buffers, budget, context);
    check_animation_times(document, model, buffers, budget, context);
    images.check_unused();
    if (error) throw Error(*error);
}

void read_with_causes(const Context& context, const Target& target) {
    try {
        read(context, target);
    } catch (const Error& error) {
        // What was noticed on the way is often the cause.
        const std::vector<std::string>& warnings = context.report.warnings;
        if (error.code() != ExitCode::invalid_data || warnings.empty()) throw;
        std::string message = error.what();
        constexpr std::size_t most = 4;
        for (std::size_t i = 0; i < warnings.size() && i < most; ++i)
            message += (i == 0 ? " (also: " : "; ") + warnings[i];
        throw Error(error.code(), message + ")");
    }
}

} // namespace
} // namespace gltf

Result read_gltf(const Asset& asset, const Limits& limits) {
    Result result;
    References references(asset, limits, result.report);
    gltf::read_with_causes({asset, limits, result.report, references}, {result.model});
    return result;
}

SceneResult read_gltf_scene(const Asset& asset, const Limits& limits, const SceneOptions& options) {
    SceneResult result;
    References references(asset, limits, result.report);
    gltf::read_with_causes({asset, limits, result.report, references},
                           {result.scene.model, &result.scene, options.rig});
    return result;
}

} // namespace spa::import
