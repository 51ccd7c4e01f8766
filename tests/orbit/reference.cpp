// SPDX-License-Identifier: Apache-2.0
#include "reference.h"

#include "../../libspa/core/element_format.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>

namespace spa::test {
namespace {

constexpr double edge_margin = 2e-6;   // of the unit sphere's radius
constexpr double alpha_margin = 0.004; // a code

struct View {
    Vec3d direction, right, up;
};

View make_view(Vec3d direction) {
    const Vec3d helper = std::abs(direction.x) < 0.6 ? Vec3d{1, 0, 0} : Vec3d{0, 0, 1};
    const Vec3d right = normalize(cross(helper, direction));
    return {direction, right, cross(direction, right)};
}

double wrap_coordinate(Wrap wrap, double i, double size) {
    switch (wrap) {
    case Wrap::repeat: return i - size * std::floor(i / size);
    case Wrap::mirrored_repeat: {
        const double m = i - 2 * size * std::floor(i / (2 * size));
        return m < size ? m : 2 * size - 1 - m;
    }
    case Wrap::clamp_to_edge: return std::clamp(i, 0.0, size - 1);
    }
    return 0;
}

Vec4f scaled(Vec4f v, double s) { return {float(v.x * s), float(v.y * s), float(v.z * s), float(v.w * s)}; }
Vec4f sum(Vec4f a, Vec4f b) { return {a.x + b.x, a.y + b.y, a.z + b.z, a.w + b.w}; }
Vec4f product(Vec4f a, Vec4f b) { return {a.x * b.x, a.y * b.y, a.z * b.z, a.w * b.w}; }

Vec4f texel_at(const Image& image, const Material& material, double i, double j) {
    const auto x = std::size_t(wrap_coordinate(material.wrap_u, i, image.width));
    const auto y = std::size_t(wrap_coordinate(material.wrap_v, j, image.height));
    const auto& p = image.pixels[y * image.width + x];
    return {srgb_to_linear(p[0]), srgb_to_linear(p[1]), srgb_to_linear(p[2]), float(p[3]) / 255.0F};
}

Vec4f filter(const Image& image, const Material& material, Vec2d uv, bool nearest) {
    const double x = uv.x * image.width;
    const double y = uv.y * image.height;
    if (nearest) return texel_at(image, material, std::floor(x), std::floor(y));
    const double i = std::floor(x - 0.5);
    const double j = std::floor(y - 0.5);
    Vec4f result{};
    for (int dj = 0; dj < 2; ++dj) {
        for (int di = 0; di < 2; ++di) {
            const double weight = (1 - std::abs(x - 0.5 - (i + di))) * (1 - std::abs(y - 0.5 - (j + dj)));
            result = sum(result, scaled(texel_at(image, material, i + di, j + dj), weight));
        }
    }
    return result;
}

// True where nearest filtering, uv a hair aside, would give another texel.
bool at_texel_border(const Image& image, Vec2d uv) {
    const auto near = [](double x) { return std::abs(x - std::round(x)) < 1e-3; };
    return near(uv.x * image.width) || near(uv.y * image.height);
}

struct Hit {
    bake::Crossing crossing;
    bool visible = true;
    bool undecided = false;
};

class Caster {
public:
    Caster(const bake::CenteredModel& model, const Grid& grid, TexelIndex texel)
        : model_(model), view_(make_view(normalize(sample_direction(grid, texel)))),
          solid_angle_(solid_angle(grid, texel)) {}

    std::optional<Hit> cast(std::uint32_t triangle) const {
        const auto& vertex = model_.model->triangles[triangle].vertex;
        Vec3d p[3];
        Vec2d q[3];
        for (int k = 0; k < 3; ++k) {
            p[k] = to_double(model_.positions[vertex[std::size_t(k)]]);
            q[k] = {dot(view_.right, p[k]), dot(view_.up, p[k])};
        }
        // Twice the signed areas of the triangle and of those that the axis makes with its sides.
        const auto area = [](Vec2d a, Vec2d b, Vec2d c) {
            return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
        };
        const double whole = area(q[0], q[1], q[2]);
        double weight[3];
        double margin = 1;
        for (int k = 0; k < 3; ++k) {
            const Vec2d a = q[(k + 1) % 3];
            const Vec2d b = q[(k + 2) % 3];
            const double side = std::hypot(b.x - a.x, b.y - a.y);
            const double part = area(a, b, {0, 0}) * (whole < 0 ? -1 : 1);
            margin = std::min(margin, side > 0 ? part / side : -1);
            weight[k] = part / std::abs(whole);
        }
        if (margin < -edge_margin || whole == 0) return std::nullopt;
        double radius = 0;
        for (int k = 0; k < 3; ++k) radius += weight[k] * dot(view_.direction, p[k]);
        Hit hit;
        hit.undecided = margin < edge_margin || std::abs(radius) < edge_margin;
        if (!hit.undecided && radius <= 0) return std::nullopt;
        hit.crossing.radius = float(radius);
        hit.crossing.triangle = triangle;
        hit.crossing.front_facing = (whole > 0) != model_.mirrored;
        Vec3d normal;
        for (int k = 0; k < 3; ++k) {
            normal = normal + to_double(model_.normals[vertex[std::size_t(k)]]) * weight[k];
        }
        hit.crossing.normal = to_float(normalize(normal));
        shade(hit, p, weight, radius);
        return hit;
    }

private:
    void shade(Hit& hit, const Vec3d (&p)[3], const double (&weight)[3], double radius) const {
        const Model& model = *model_.model;
        const auto& vertex = model.triangles[hit.crossing.triangle].vertex;
        const Material& material = model.materials[model.triangle_materials[hit.crossing.triangle]];
        Vec4f color = material.base_color;
        if (!model.colors.empty()) {
            Vec4f mixed{};
            for (std::size_t k = 0; k < 3; ++k)
                mixed = sum(mixed, scaled(model.colors[vertex[k]], weight[k]));
            color = product(color, mixed);
        }
        if (material.texture != no_index) {
            const std::vector<Image>& mips = model.textures[material.texture].mips;
            Vec2d uv[3];
            Vec2d at;
            for (std::size_t k = 0; k < 3; ++k) {
                uv[k] = {model.uvs[vertex[k]].x, model.uvs[vertex[k]].y};
                at = at + uv[k] * weight[k];
            }
            const Vec3d plane = cross(p[1] - p[0], p[2] - p[0]);
            const double cosine = std::max(std::abs(dot(normalize(plane), view_.direction)), 0.05);
            const double footprint = solid_angle_ * radius * radius / cosine;
            const Vec2d eb = uv[1] - uv[0];
            const Vec2d ec = uv[2] - uv[0];
            const double texels = std::abs(eb.x * ec.y - eb.y * ec.x) * mips[0].width * mips[0].height;
            const double level = std::log2(std::sqrt(footprint / length(plane) * texels));
            if (level > 0) {
                const double last = double(mips.size() - 1);
                const double lower = std::floor(std::min(level, last));
                const double upper = std::min(lower + 1, last);
                const double f = std::min(level, last) - lower;
                color =
                    product(color, sum(scaled(filter(mips[std::size_t(lower)], material, at, false), 1 - f),
                                       scaled(filter(mips[std::size_t(upper)], material, at, false), f)));
            } else {
                color = product(color, filter(mips[0], material, at, material.nearest));
            }
            if (material.nearest && (std::abs(level) < 0.01 || at_texel_border(mips[0], at)))
                hit.undecided = true;
        }
        double alpha = 1;
        if (material.alpha_mode == AlphaMode::mask) {
            hit.visible = color.w >= material.alpha_cutoff;
            if (std::abs(color.w - material.alpha_cutoff) < alpha_margin) hit.undecided = true;
        } else if (material.alpha_mode == AlphaMode::blend) {
            alpha = color.w;
            hit.visible = alpha * 255 >= 0.5;
            if (std::abs(alpha * 255 - 0.5) < 0.1) hit.undecided = true;
        }
        hit.crossing.color = {linear_to_srgb(color.x), linear_to_srgb(color.y), linear_to_srgb(color.z),
                              std::uint8_t(std::lround(std::clamp(alpha, 0.0, 1.0) * 255))};
    }

    const bake::CenteredModel& model_;
    View view_;
    double solid_angle_;
};

} // namespace

bake::CenteredModel normalized(const Model& model) {
    bake::CenteredModel result;
    result.model = &model;
    result.normals = model.normals;
    float largest = 0;
    for (const Vec3f p : model.positions) largest = std::max(largest, length(p));
    for (const Vec3f p : model.positions) result.positions.push_back(p * (0.999999F / largest));
    return result;
}

Model random_textured_soup(std::uint32_t count, std::uint32_t seed) {
    std::mt19937 random(seed);
    const auto uniform = [&](float low, float high) {
        return low + (high - low) * float(double(random()) / 4294967296.0);
    };
    Model model;
    for (const auto& [width, height] : {std::pair{64U, 32U}, std::pair{37U, 5U}, std::pair{1U, 1U}}) {
        Texture texture;
        texture.mips.push_back({width, height, {}});
        for (std::uint32_t i = 0; i < width * height; ++i) {
            const std::uint32_t bits = std::uint32_t(random());
            texture.mips[0].pixels.push_back({std::uint8_t(bits), std::uint8_t(bits >> 8U),
                                              std::uint8_t(bits >> 16U), std::uint8_t(bits >> 24U)});
        }
        build_mips(texture);
        model.textures.push_back(texture);
    }
    constexpr Wrap wraps[] = {Wrap::repeat, Wrap::mirrored_repeat, Wrap::clamp_to_edge};
    constexpr AlphaMode modes[] = {AlphaMode::opaque, AlphaMode::mask, AlphaMode::blend};
    for (std::uint32_t i = 0; i < 12; ++i) {
        Material material;
        material.base_color = {uniform(0.5F, 1), uniform(0.5F, 1), uniform(0.5F, 1), uniform(0.7F, 1)};
        if (i % 4 != 3) material.texture = i % 4;
        material.wrap_u = wraps[i % 3];
        material.wrap_v = wraps[(i / 3) % 3];
        material.nearest = i % 2 == 1;
        material.alpha_mode = modes[(i / 2) % 3];
        material.alpha_cutoff = 0.3F;
        model.materials.push_back(material);
    }
    for (std::uint32_t t = 0; t < count; ++t) {
        const Vec3f middle{uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)};
        const float size = uniform(0.1F, 1);
        for (int k = 0; k < 3; ++k) {
            model.positions.push_back(
                middle + Vec3f{uniform(-size, size), uniform(-size, size), uniform(-size, size)});
            model.normals.push_back(normalize(Vec3f{uniform(-1, 1), uniform(-1, 1), uniform(1, 2)}));
            model.uvs.push_back({uniform(-2, 3), uniform(-2, 3)});
            model.colors.push_back({uniform(0.5F, 1), uniform(0.5F, 1), uniform(0.5F, 1), uniform(0.8F, 1)});
        }
        model.triangles.push_back({{3 * t, 3 * t + 1, 3 * t + 2}});
        model.triangle_materials.push_back(std::uint32_t(random() % model.materials.size()));
    }
    return model;
}

std::optional<std::vector<bake::Crossing>> cast_reference(const bake::CenteredModel& model, const Grid& grid,
                                                          TexelIndex texel) {
    const Caster caster(model, grid, texel);
    std::vector<bake::Crossing> crossings;
    for (std::uint32_t t = 0; t < std::uint32_t(model.model->triangles.size()); ++t) {
        const std::optional<Hit> hit = caster.cast(t);
        if (!hit) continue;
        if (hit->undecided) return std::nullopt;
        if (hit->visible) crossings.push_back(hit->crossing);
    }
    std::sort(crossings.begin(), crossings.end(),
              [](const bake::Crossing& a, const bake::Crossing& b) { return a.radius > b.radius; });
    for (std::size_t i = 1; i < crossings.size(); ++i) {
        if (crossings[i - 1].radius - crossings[i].radius < 2 * bake::merge_distance) return std::nullopt;
    }
    return crossings;
}

Comparison compare_with_reference(const bake::CrossingGrid& crossings, const bake::CenteredModel& model,
                                  bool layers, std::size_t step) {
    Comparison result;
    const Grid& grid = crossings.grid;
    for (std::uint32_t y = 0; y < grid.height; ++y) {
        for (std::uint32_t x = 0; x < grid.width; ++x) {
            const std::size_t sample = std::size_t(y) * grid.width + x;
            if (sample % step != 0) continue;
            auto expected = cast_reference(model, grid, {x, y});
            if (!expected) {
                ++result.undecided;
                continue;
            }
            ++result.compared;
            if (!layers && expected->size() > 1) expected->resize(1);
            const std::size_t first = crossings.first[sample];
            bool same = crossings.first[sample + 1] - first == expected->size();
            for (std::size_t i = 0; same && i < expected->size(); ++i) {
                const bake::Crossing& a = (*expected)[i];
                const bake::Crossing& b = crossings.crossings[first + i];
                same = a.triangle == b.triangle && a.front_facing == b.front_facing;
                if (!same) break;
                result.radius = std::max(result.radius, std::abs(double(a.radius) - double(b.radius)));
                result.normal = std::max(result.normal, double(length(a.normal - b.normal)));
                for (std::size_t c = 0; c < 4; ++c) {
                    result.color = std::max(result.color, std::abs(int(a.color[c]) - int(b.color[c])));
                }
            }
            if (!same) ++result.wrong;
        }
    }
    return result;
}

} // namespace spa::test
