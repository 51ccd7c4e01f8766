// SPDX-License-Identifier: Apache-2.0
// The boot: 20 rings of 16 vertices from the rim down the leg, round the ankle and along the foot, then a cap
// of 14 vertices at the toe. V = 20*16 + 14 = 334, F = 19*32 + 42 = 650, E = V + F - 1 = 983: a disc whose
// border is the rim. The mesh is its own mirror image in the plane x = 0, and that plane runs along edges.
#include "boot_texture.h"
#include "shapes.h"

#include "../libspa/mesh/subdivide.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace spa::samples {
namespace {

constexpr std::uint32_t ring_size = 16, half_ring = ring_size / 2;

// Column 0 of a ring is the front of the leg and the upper side of the foot, column 8 its back and the sole;
// columns 1..7 are on the +X side, 9..15 mirror them.
using HalfRing = std::array<Vec3d, half_ring + 1>;

// In the plane x = 0.
struct Sagittal {
    double y, z;
};

// Leg: an ellipse between two points of the sagittal plane.
struct LegRing {
    Sagittal front, back;
    double half_width;
    double descent; // how far the side columns are moved on towards the back, 0..1
};

// Foot: a rounded upper on a sole with an edge.
struct FootRing {
    Sagittal top;
    Vec3d upper; // where the upper meets the welt
    Vec3d welt;  // upper edge of the sole
    Vec3d edge;  // lower edge of the sole
    Vec3d quarter;
    Sagittal bottom;
};

// The leg is short and the instep high enough for the centre of the bounds to be inside the boot.
constexpr LegRing leg[] = {
    {{.280, .068}, {.280, -.100}, .070, 0},   {{.272, .067}, {.272, -.099}, .069, 0},
    {{.250, .063}, {.249, -.096}, .064, 0},   {{.226, .061}, {.222, -.092}, .060, 0},
    {{.204, .061}, {.190, -.088}, .056, 0},   {{.184, .063}, {.156, -.085}, .052, .06},
    {{.168, .068}, {.117, -.084}, .048, .16}, {{.155, .075}, {.078, -.089}, .044, .30},
};

constexpr FootRing foot[] = {
    // The heel: its upper edge, its lower edge, the middle and the front of its sole.
    {{.145, .083},
     {.039, .056, -.056},
     {.044, .041, -.074},
     {.035, .039, -.093},
     {.020, .039, -.104},
     {.039, -.107}},
    {{.137, .091},
     {.041, .054, -.043},
     {.046, .039, -.053},
     {.036, .000, -.080},
     {.020, .000, -.096},
     {.000, -.101}},
    {{.129, .099},
     {.042, .052, -.030},
     {.047, .038, -.036},
     {.039, .000, -.048},
     {.020, .000, -.050},
     {.000, -.050}},
    {{.122, .107},
     {.042, .050, -.018},
     {.047, .037, -.021},
     {.040, .000, -.023},
     {.020, .000, -.021},
     {.000, -.021}},
    // The waist, behind the step.
    {{.115, .116},
     {.042, .047, -.003},
     {.047, .035, -.006},
     {.042, .027, -.016},
     {.020, .030, -.016},
     {.031, -.016}},
    {{.107, .127},
     {.042, .044, .017},
     {.048, .033, .015},
     {.045, .020, .009},
     {.021, .022, .008},
     {.023, .008}},
    // The ball and the toe.
    {{.098, .140},
     {.044, .040, .046},
     {.053, .028, .046},
     {.051, .010, .044},
     {.025, .011, .044},
     {.011, .044}},
    {{.091, .153},
     {.047, .036, .080},
     {.056, .023, .080},
     {.055, .001, .080},
     {.027, .001, .080},
     {.001, .080}},
    {{.085, .165},
     {.048, .035, .112},
     {.058, .022, .112},
     {.057, .000, .112},
     {.028, .000, .112},
     {.000, .112}},
    {{.080, .177},
     {.047, .035, .142},
     {.057, .022, .143},
     {.056, .001, .143},
     {.028, .001, .143},
     {.001, .143}},
    {{.074, .189},
     {.042, .036, .169},
     {.049, .023, .171},
     {.048, .003, .170},
     {.025, .003, .171},
     {.003, .172}},
    {{.064, .200},
     {.033, .038, .191},
     {.036, .026, .194},
     {.035, .008, .192},
     {.018, .006, .193},
     {.006, .194}},
};

// The cap: half a ring of 12 from top to bottom, and one vertex a side within it.
constexpr Vec3d cap[] = {{0, .051, .209},    {.013, .049, .208}, {.024, .041, .206}, {.027, .029, .205},
                         {.025, .016, .203}, {.013, .012, .205}, {0, .012, .207}};
constexpr Vec3d cap_centre{.011, .031, .209};
constexpr std::uint32_t cap_size = 12, half_cap = cap_size / 2;

constexpr std::uint32_t ring_count = std::size(leg) + std::size(foot);
static_assert(ring_count == 20 && std::size(cap) == half_cap + 1);

HalfRing half_ring_of(const LegRing& ring) {
    HalfRing result;
    for (std::uint32_t c = 0; c <= half_ring; ++c) {
        const double t = double(c) / half_ring;
        const double angle = std::numbers::pi * (t + ring.descent * t * (1 - t));
        const double s = (1 - std::cos(angle)) / 2;
        result.at(c) = {ring.half_width * std::sin(angle), std::lerp(ring.front.y, ring.back.y, s),
                        std::lerp(ring.front.z, ring.back.z, s)};
    }
    result.back().x = 0; // sin(pi) is not 0 in floating point
    return result;
}

HalfRing half_ring_of(const FootRing& ring) {
    HalfRing result;
    for (std::uint32_t c = 0; c <= 4; ++c) {
        const double angle = std::numbers::pi / 2 * c / 4;
        const double s = 1 - std::cos(angle);
        result.at(c) = {ring.upper.x * std::sin(angle), std::lerp(ring.top.y, ring.upper.y, s),
                        std::lerp(ring.top.z, ring.upper.z, s)};
    }
    result[5] = ring.welt;
    result[6] = ring.edge;
    result[7] = ring.quarter;
    result[8] = {0, ring.bottom.y, ring.bottom.z};
    return result;
}

class Builder {
public:
    ControlMesh build() && {
        for (const LegRing& ring : leg) add_ring(half_ring_of(ring));
        for (const FootRing& ring : foot) add_ring(half_ring_of(ring));
        for (std::uint32_t ring = 0; ring + 1 < ring_count; ++ring) join(ring);
        add_cap();
        return std::move(mesh_);
    }

private:
    static Vec3d mirrored(Vec3d p) { return {-p.x, p.y, p.z}; }

    // The disc unrolls onto the texture: rim outside, toe in the middle, the sagittal plane at u = 1/2.
    // turn: 0 = front, 1 = back, from there on the other side; u is 1/2 exactly on the plane.
    void add(Vec3d position, double radius, double turn) {
        const double across = position.x == 0 ? 0 : std::sin(std::numbers::pi * turn);
        mesh_.positions.push_back(position);
        mesh_.uvs.push_back({0.5 + radius * across, 0.5 + radius * std::cos(std::numbers::pi * turn)});
    }

    // step: rings from the rim; the cap goes on counting.
    static double texture_radius(double step) { return 0.49 * (1 - step / (ring_count + 1.5)); }

    // Half a ring and its mirror image.
    template <std::size_t n>
    void add_both_halves(const Vec3d (&half)[n], double step) {
        constexpr std::size_t last = n - 1;
        for (std::size_t c = 0; c < n; ++c) add(half[c], texture_radius(step), double(c) / last);
        for (std::size_t c = last - 1; c > 0; --c)
            add(mirrored(half[c]), texture_radius(step), -double(c) / last);
    }

    void add_ring(const HalfRing& half) {
        Vec3d points[half_ring + 1];
        std::copy(half.begin(), half.end(), points);
        add_both_halves(points, rings_++);
    }

    static std::uint32_t vertex(std::uint32_t ring, std::uint32_t column) {
        return ring * ring_size + column % ring_size;
    }

    // Diagonals of the two sides mirror each other.
    void join(std::uint32_t ring) {
        for (std::uint32_t c = 0; c < ring_size; ++c) {
            const std::uint32_t a = vertex(ring, c), b = vertex(ring, c + 1);
            const std::uint32_t d = vertex(ring + 1, c), e = vertex(ring + 1, c + 1);
            if (c < half_ring) {
                mesh_.triangles.push_back({{a, d, e}});
                mesh_.triangles.push_back({{a, e, b}});
            } else {
                mesh_.triangles.push_back({{a, d, b}});
                mesh_.triangles.push_back({{b, d, e}});
            }
        }
    }

    // A triangle of the +X half of the cap and its mirror image.
    struct CapCorner {
        enum Kind { outer, inner, centre } kind;
        std::uint32_t column;
    };
    std::uint32_t cap_vertex(CapCorner corner, bool mirror) const {
        const std::uint32_t first = ring_count * ring_size;
        switch (corner.kind) {
        case CapCorner::outer:
            return vertex(ring_count - 1, mirror ? ring_size - corner.column : corner.column);
        case CapCorner::inner: return first + (mirror ? cap_size - corner.column : corner.column) % cap_size;
        case CapCorner::centre: break;
        }
        return first + cap_size + (mirror ? 1 : 0);
    }
    void add_cap_triangle(CapCorner a, CapCorner b, CapCorner c) {
        mesh_.triangles.push_back({{cap_vertex(a, false), cap_vertex(b, false), cap_vertex(c, false)}});
        mesh_.triangles.push_back({{cap_vertex(a, true), cap_vertex(c, true), cap_vertex(b, true)}});
    }

    void add_cap() {
        add_both_halves(cap, ring_count);
        add(cap_centre, texture_radius(ring_count + 1), 0.5);
        add(mirrored(cap_centre), texture_radius(ring_count + 1), -0.5);
        using enum CapCorner::Kind;
        // The band between 16 and 12 vertices: step on along whichever side is behind.
        for (std::uint32_t o = 0, i = 0; o < half_ring || i < half_cap;) {
            if ((o + 1) * half_cap <= (i + 1) * half_ring && o < half_ring) {
                add_cap_triangle({outer, o}, {inner, i}, {outer, o + 1});
                ++o;
            } else {
                add_cap_triangle({outer, o}, {inner, i}, {inner, i + 1});
                ++i;
            }
        }
        for (std::uint32_t i = 0; i < half_cap; ++i)
            add_cap_triangle({inner, i}, {centre, 0}, {inner, i + 1});
        add_cap_triangle({inner, half_cap}, {centre, 0}, {inner, 0});
    }

    ControlMesh mesh_;
    std::uint32_t rings_ = 0;
};

} // namespace

Model make_boot(int level) {
    const ControlMesh mesh = subdivide_loop(Builder().build(), static_cast<unsigned>(level));
    Model model = empty_model("boot");
    model.positions.reserve(mesh.positions.size());
    model.uvs.reserve(mesh.uvs.size());
    for (const Vec3d& p : mesh.positions) model.positions.push_back(to_float(p));
    for (const Vec2d& uv : mesh.uvs) model.uvs.push_back({float(uv.x), float(uv.y)});
    model.triangles = mesh.triangles;
    model.triangle_materials.assign(mesh.triangles.size(), 0);
    model.materials.front().double_sided = true; // the inside shows through the open top
    set_smooth_normals(model);
    set_texture(model, "orange and blue", boot_texture());
    return model;
}

} // namespace spa::samples
