// SPDX-License-Identifier: Apache-2.0
#include "gltf_primitive.h"

#include "gltf_triangles.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace spa::import::gltf {
namespace {

constexpr const char* draco_extension = "KHR_draco_mesh_compression";
constexpr const char* joints_attribute = ".attributes.JOINTS_0";

// One primitive's attributes, wherever they are kept, for the vertices in `subset` (empty: all).
class Attributes {
public:
    Attributes(Assembly& assembly, const tinygltf::Primitive& primitive, const DracoMesh* draco)
        : assembly_(assembly), primitive_(primitive), draco_(draco) {}

    std::vector<std::uint32_t> subset;

    [[nodiscard]] bool has(const std::string& name) const { return primitive_.attributes.count(name) != 0; }

    // COLOR_0 of integers is always a fraction, whether the accessor says so or not.
    [[nodiscard]] bool is_unscaled_integer(const std::string& name) const {
        const tinygltf::Accessor& of = accessor(name);
        return !of.normalized && of.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT;
    }

    void floats(const std::string& name, std::size_t wanted, float* out) const {
        const Elements* decoded = draco_elements(name);
        if (decoded != nullptr)
            read_floats(*decoded, subset, wanted, out, wanted);
        else
            read_floats(accessor(name), assembly_.buffers, subset, wanted, out, wanted, assembly_.context);
    }

    void integers(const std::string& name, std::size_t wanted, std::uint32_t* out, std::size_t stride) const {
        const Elements* decoded = draco_elements(name);
        read_integers(decoded != nullptr ? *decoded : elements_of(accessor(name), assembly_.buffers), subset,
                      wanted, out, stride);
    }

    void weights(const std::string& name, float* out, std::size_t stride) const {
        const Elements* decoded = draco_elements(name);
        if (decoded != nullptr)
            read_floats(*decoded, subset, 4, out, stride);
        else
            read_floats(accessor(name), assembly_.buffers, subset, 4, out, stride, assembly_.context);
    }

private:
    Assembly& assembly_;
    const tinygltf::Primitive& primitive_;
    const DracoMesh* draco_;

    [[nodiscard]] const tinygltf::Accessor& accessor(const std::string& name) const {
        return assembly_.model.accessors[static_cast<std::size_t>(primitive_.attributes.at(name))];
    }
    [[nodiscard]] const Elements* draco_elements(const std::string& name) const {
        if (draco_ == nullptr) return nullptr;
        const auto found = draco_->attributes.find(name);
        return found == draco_->attributes.end() ? nullptr : &found->second;
    }
};

// The state of one append_primitive.
struct Drawing {
    Assembly& assembly;
    const tinygltf::Mesh& mesh;
    const tinygltf::Node& node;
    const tinygltf::Primitive& primitive;
    const Instance& instance;
    std::string where;
    std::size_t base = 0;  // the first vertex
    std::size_t first = 0; // the first triangle
    std::size_t count = 0; // vertices

    [[nodiscard]] std::span<Vec3f> positions() const {
        return std::span(assembly.out.positions).subspan(base, count);
    }
    [[nodiscard]] std::span<Vec3f> normals() const {
        return std::span(assembly.out.normals).subspan(base, count);
    }
};

const DracoMesh* draco_of(Drawing& drawing, std::size_t number) {
    if (drawing.primitive.extensions.count(draco_extension) == 0) return nullptr;
    const std::pair key{static_cast<std::size_t>(drawing.node.mesh), number};
    auto found = drawing.assembly.draco.find(key);
    if (found == drawing.assembly.draco.end())
        found =
            drawing.assembly.draco
                .emplace(key, decode_draco(drawing.assembly.model, drawing.primitive,
                                           drawing.assembly.buffers, drawing.where, drawing.assembly.context))
                .first;
    return &found->second;
}

void append_indices(Drawing& drawing, const DracoMesh* draco, std::size_t vertices) {
    Assembly& assembly = drawing.assembly;
    const std::string where = drawing.where + ".indices";
    Elements indices;
    const Elements* used = nullptr;
    int mode = drawing.primitive.mode;
    if (draco != nullptr) {
        indices = {std::as_bytes(std::span(draco->indices)),
                   sizeof(std::uint32_t),
                   draco->indices.size(),
                   TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT,
                   1,
                   false};
        used = &indices;
        mode = TINYGLTF_MODE_TRIANGLES; // Draco stores single triangles, whatever the strip was
    } else if (drawing.primitive.indices >= 0) {
        indices = elements_of(assembly.model.accessors[static_cast<std::size_t>(drawing.primitive.indices)],
                              assembly.buffers);
        used = &indices;
    }
    append_triangles(used, vertices, mode, where, assembly.context, assembly.out.triangles);
}

// The joints' weights, if the drawing is skinned.
std::optional<VertexWeights> read_weights(const Drawing& drawing, const Attributes& attributes) {
    if (drawing.node.skin < 0 || !attributes.has("JOINTS_0") || !attributes.has("WEIGHTS_0"))
        return std::nullopt;
    VertexWeights weights;
    const auto joints = [](std::size_t set) { return "JOINTS_" + std::to_string(set); };
    const auto shares = [](std::size_t set) { return "WEIGHTS_" + std::to_string(set); };
    while (attributes.has(joints(weights.sets)) && attributes.has(shares(weights.sets))) ++weights.sets;
    const std::size_t per_vertex = weights.sets * 4;
    weights.joints.resize(drawing.count * per_vertex);
    weights.weights.resize(drawing.count * per_vertex);
    for (std::size_t set = 0; set < weights.sets; ++set) {
        attributes.integers(joints(set), 4, weights.joints.data() + set * 4, per_vertex);
        attributes.weights(shares(set), weights.weights.data() + set * 4, per_vertex);
    }
    return weights;
}

std::span<const Affine> joints_of(Drawing& drawing) {
    Assembly& assembly = drawing.assembly;
    auto found = assembly.skins.find(drawing.node.skin);
    if (found == assembly.skins.end()) {
        const tinygltf::Skin& skin = assembly.model.skins[static_cast<std::size_t>(drawing.node.skin)];
        found = assembly.skins
                    .emplace(drawing.node.skin, joint_matrices(assembly.model, skin, assembly.globals,
                                                               assembly.buffers, assembly.context))
                    .first;
    }
    return found->second;
}

void transform_normal(Vec3f& normal, const Mat3& by) { normal = to_float(normalize(by * to_double(normal))); }

// What is of unit length to the last digits stays as it is.
void normalize_in_place(std::span<Vec3f> normals) {
    for (Vec3f& normal : normals)
        if (!(std::abs(dot(normal, normal) - 1.0F) < 1e-6F)) normal = to_float(normalize(to_double(normal)));
}

// Places the vertices; `mirrored[v]` where the surface there is turned inside out.
void pose(Drawing& drawing, const std::optional<VertexWeights>& weights, bool has_normals,
          std::vector<std::uint8_t>& mirrored) {
    const std::span<Vec3f> positions = drawing.positions();
    const std::span<Vec3f> normals = has_normals ? drawing.normals() : std::span<Vec3f>{};
    if (weights) {
        const std::span<const Affine> joints = joints_of(drawing);
        check_weights(*weights, joints.size(), drawing.where + joints_attribute, drawing.assembly.context);
        mirrored.resize(positions.size());
        for (std::size_t v = 0; v < positions.size(); ++v) {
            const Affine map = weights->blend(v, joints, drawing.instance.world);
            positions[v] = to_float(transform_point(map, to_double(positions[v])));
            mirrored[v] = determinant(map.linear) < 0 ? 1 : 0;
            if (has_normals) transform_normal(normals[v], normal_matrix(map.linear));
        }
        return;
    }
    const Affine& map = drawing.instance.world;
    if (map.linear == Mat3{} && map.translation == Vec3d{}) {
        normalize_in_place(normals);
        return;
    }
    for (Vec3f& position : positions) position = to_float(transform_point(map, to_double(position)));
    const Mat3 by = normal_matrix(map.linear);
    for (Vec3f& normal : normals) transform_normal(normal, by);
    if (determinant(map.linear) < 0) mirrored.assign(1, 1);
}

// Whether the primitive has the uv set that its material's texture wants; if so they are read.
bool read_uvs(Drawing& drawing, const Attributes& attributes, std::uint32_t material) {
    Model& out = drawing.assembly.out;
    const UvSource& source = drawing.assembly.materials.uv(material);
    const std::string name = "TEXCOORD_" + std::to_string(source.set);
    if (!attributes.has(name)) {
        warn(drawing.assembly.context, drawing.where + ".attributes",
             "has no " + name +
                 ", which the base colour texture of its material needs: drawn without texture");
        return false;
    }
    out.uvs.resize(drawing.base + drawing.count);
    const std::span<Vec2f> uvs = std::span(out.uvs).subspan(drawing.base);
    attributes.floats(name, 2, &uvs[0].x);
    const std::array<double, 6>& m = source.matrix;
    bool finite = true;
    for (Vec2f& uv : uvs) {
        if (!source.identity) {
            const double u = double(uv.x), v = double(uv.y);
            uv = {static_cast<float>(m[0] * u + m[1] * v + m[2]),
                  static_cast<float>(m[3] * u + m[4] * v + m[5])};
        }
        if (std::isfinite(uv.x) && std::isfinite(uv.y)) continue;
        uv = {};
        finite = false;
    }
    if (!finite)
        warn(drawing.assembly.context, drawing.where + ".attributes." + name,
             "has values that are not finite, which become 0");
    return true;
}

void read_colors(Drawing& drawing, const Attributes& attributes) {
    if (!attributes.has("COLOR_0")) return;
    const Context& context = drawing.assembly.context;
    const std::string where = drawing.where + ".attributes.COLOR_0";
    Model& out = drawing.assembly.out;
    out.colors.resize(drawing.base + drawing.count, {1, 1, 1, 1});
    const std::span<Vec4f> colors = std::span(out.colors).subspan(drawing.base);
    attributes.floats("COLOR_0", 4, &colors[0].x);
    float scale = 1;
    if (attributes.is_unscaled_integer("COLOR_0")) {
        warn(context, where, "has integers that are not normalized; they are read as if they were");
        const tinygltf::Accessor& accessor =
            drawing.assembly.model
                .accessors[static_cast<std::size_t>(drawing.primitive.attributes.at("COLOR_0"))];
        scale = accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ? 1.0F / 255 : 1.0F / 65535;
        if (accessor.type == TINYGLTF_TYPE_VEC3)
            for (Vec4f& color : colors) color.w = 1.0F / scale;
    }
    const auto clamp = [&](float& value) { // check_colors has warned
        value *= scale;
        if (!(value >= 0.0F && value <= 1.0F)) value = value > 1.0F ? 1.0F : 0.0F; // NaN becomes 0
    };
    for (Vec4f& color : colors) {
        clamp(color.x);
        clamp(color.y);
        clamp(color.z);
        clamp(color.w);
    }
}

} // namespace

bool is_drawn(const tinygltf::Primitive& primitive) {
    return (primitive.mode >= TINYGLTF_MODE_TRIANGLES || primitive.extensions.count(draco_extension) != 0) &&
           primitive.attributes.count("POSITION") != 0;
}

Size size_of(const tinygltf::Model& model, const tinygltf::Primitive& primitive) {
    const std::uint64_t vertices =
        model.accessors[static_cast<std::size_t>(primitive.attributes.at("POSITION"))].count;
    std::uint64_t corners = vertices;
    if (primitive.indices >= 0) corners = model.accessors[static_cast<std::size_t>(primitive.indices)].count;
    Size size;
    size.triangles = primitive.mode == TINYGLTF_MODE_TRIANGLES || corners < 2 ? corners / 3 : corners - 2;
    const bool flat = primitive.attributes.count("NORMAL") == 0;
    size.reads = vertices * primitive.targets.size();
    for (const auto& [name, index] : primitive.attributes)
        if (model.accessors[static_cast<std::size_t>(index)].sparse.isSparse) size.reads += vertices;
    size.vertices = flat ? 3 * size.triangles : std::min(vertices, 3 * size.triangles);
    std::uint64_t sets = 0;
    while (primitive.attributes.count("JOINTS_" + std::to_string(sets)) != 0) ++sets;
    size.influences = size.vertices * std::max<std::uint64_t>(4 * sets, 1);
    return size;
}

void append_primitive(Assembly& assembly, const Instance& instance, std::size_t number) {
    const tinygltf::Node& node = assembly.model.nodes[instance.node];
    const tinygltf::Mesh& mesh = assembly.model.meshes[static_cast<std::size_t>(node.mesh)];
    const tinygltf::Primitive& primitive = mesh.primitives[number];
    Model& out = assembly.out;
    Drawing drawing{
        assembly, mesh,
        node,     primitive,
        instance, at("meshes", static_cast<std::size_t>(node.mesh)) + "." + at("primitives", number)};
    drawing.base = out.positions.size();
    drawing.first = out.triangles.size();

    const DracoMesh* draco = draco_of(drawing, number);
    Attributes attributes(assembly, primitive, draco);
    const std::size_t vertices =
        draco != nullptr
            ? draco->vertices
            : assembly.model.accessors[static_cast<std::size_t>(primitive.attributes.at("POSITION"))].count;
    append_indices(drawing, draco, vertices);
    const std::size_t triangles = out.triangles.size() - drawing.first;
    if (triangles == 0) return;
    // A few triangles of a shared vertex buffer: reading all of it for each primitive would take for ever.
    if (vertices > 3 * triangles) attributes.subset = renumber_used(out.triangles, drawing.first);
    drawing.count = attributes.subset.empty() ? vertices : attributes.subset.size();
    // A compressed mesh may hold more triangles than the accessors, which the limits were held against, say.
    const Limits& limits = assembly.context.limits;
    if (out.triangles.size() > limits.triangles || drawing.base + drawing.count > limits.vertices ||
        drawing.base + 3 * triangles > no_index)
        fail(assembly.context, drawing.where,
             "the scene has more vertices or triangles than the limits allow");

    out.positions.resize(drawing.base + drawing.count);
    attributes.floats("POSITION", 3, &drawing.positions()[0].x);
    const std::span<const double> weights = morph_weights(mesh, node);
    add_morph_targets(assembly.model, primitive, weights, "POSITION", assembly.buffers, attributes.subset,
                      drawing.positions(), assembly.context);
    const bool has_normals = attributes.has("NORMAL");
    if (has_normals) {
        out.normals.resize(drawing.base + drawing.count);
        attributes.floats("NORMAL", 3, &drawing.normals()[0].x);
        add_morph_targets(assembly.model, primitive, weights, "NORMAL", assembly.buffers, attributes.subset,
                          drawing.normals(), assembly.context);
    }
    Unposed unposed{{}, {}, read_weights(drawing, attributes)};
    if (assembly.rig != nullptr) {
        unposed.positions.assign(drawing.positions().begin(), drawing.positions().end());
        if (has_normals) unposed.normals.assign(drawing.normals().begin(), drawing.normals().end());
    }
    std::vector<std::uint8_t> mirrored; // empty: none; one element: all or none; else one a vertex
    pose(drawing, unposed.weights, has_normals, mirrored);

    std::uint32_t material = primitive.material >= 0 ? static_cast<std::uint32_t>(primitive.material)
                                                     : assembly.materials.default_material();
    if (out.materials[material].texture != no_index && !read_uvs(drawing, attributes, material))
        material = assembly.materials.untextured(material);
    read_colors(drawing, attributes);

    Report& report = assembly.context.report;
    finish_triangles(out, drawing.first, drawing.base, report, [&](const Triangle& triangle) {
        if (mirrored.size() <= 1) return !mirrored.empty();
        return mirrored[triangle.vertex[0]] != 0;
    });
    std::vector<std::uint32_t> from, computed;
    if (has_normals) {
        from = drop_unused_vertices(out, drawing.base, drawing.first);
        computed = repair_normals(out, drawing.base, drawing.first);
        if (!computed.empty())
            warn(assembly.context, drawing.where + ".attributes.NORMAL",
                 std::to_string(computed.size()) + " normals have no direction and are computed");
    } else {
        from = make_flat(out, drawing.base, drawing.first);
        report.computed_normals = true;
        computed.resize(assembly.rig != nullptr ? from.size() : 0);
        std::iota(computed.begin(), computed.end(), static_cast<std::uint32_t>(drawing.base));
    }
    if (assembly.rig != nullptr)
        assembly.rig->append(instance, unposed,
                             unposed.weights ? joints_of(drawing) : std::span<const Affine>{},
                             {out, drawing.base, from, computed}, drawing.where + joints_attribute);
    out.triangle_materials.resize(out.triangles.size(), material);
}

} // namespace spa::import::gltf
