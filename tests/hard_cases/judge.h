// SPDX-License-Identifier: Apache-2.0
// What a ray meets, by brute force in double precision. Written from docs/tracing.md ("The stored surface")
// alone, so that it shares neither code nor tricks with the tracers that it judges: every triangle, and every
// region of a mixed one, is a convex solid in space, and a ray is clipped against its planes.
#pragma once

#include "../../libspa/core/spherical_map.h"
#include "../../libspa/trace/ray.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace spa::test {

struct FoldRegion;
struct FoldTriangle;
struct StoredInterval;

struct RayD {
    Vec3d origin, direction; // map space; the direction of any length > 0
    double t_min = 0, t_max = 0;
};

RayD to_double(const trace::Ray& ray);

// The ray enters or leaves the solid.
struct Event {
    double t = 0;
    bool enters = false;
    trace::HitSide side = trace::HitSide::outer;
    bool open = false; // an open wall: no hit
    std::uint32_t layer = 0;
    Vec3d normal{};         // unit, out of the solid
    double core_length = 0; // above 0: what happened in the core, seen where the ray leaves it; in units of R
};

class Judge {
public:
    // part: octahedral. layers: as many of its layers at most; 0: all.
    explicit Judge(const Part& part, std::uint32_t layers = 0);

    // Every event from a little before t_min to a little after t_max, in order: they enter and leave in
    // turns.
    [[nodiscard]] std::vector<Event> events(const RayD& ray) const;

    // The closest hit of docs/tracing.md. flags: trace::TraceFlags.
    [[nodiscard]] std::optional<Event> first(const RayD& ray, std::uint32_t flags = 0) const;
    // The same among events that are known already.
    static std::optional<Event> first(const std::vector<Event>& events, const RayD& ray, std::uint32_t flags);
    // The events, but for gaps of the solid whose middle is no farther than `reach` from it.
    [[nodiscard]] std::vector<Event> without_thin_gaps(const std::vector<Event>& events, const RayD& ray,
                                                       double reach) const;

    // How far rounding may move hits of a ray that passes next to the centre, in units of R; 0: it does not.
    [[nodiscard]] double digits_lost(const RayD& ray) const;
    [[nodiscard]] bool solid(Vec3d point) const;
    // Whether the point is no farther than `reach` from the boundary of the solid, open walls left out.
    [[nodiscard]] bool near_boundary(Vec3d point, double reach) const;
    // Whether the point is that near to a face of this kind.
    [[nodiscard]] bool near_face(Vec3d point, double reach, const Event& face, bool any_layer) const;
    // Whether the point is that near to a face of the solid by which the ray enters, or leaves.
    [[nodiscard]] bool near_passage(Vec3d point, double reach, Vec3d direction, bool enters) const;
    // Whether the point is that near to the line from the centre through a sample.
    [[nodiscard]] bool near_sample_line(Vec3d point, double reach) const;
    // Points just inside those pieces whose boundaries pass the point at no more than `reach`, no farther
    // from it.
    [[nodiscard]] std::vector<Vec3d> points_inside(Vec3d point, double reach) const;

    [[nodiscard]] std::uint32_t cells() const { return 2 * n_; } // N
    [[nodiscard]] double w_core() const { return w_core_; }
    [[nodiscard]] std::size_t pieces() const { return pieces_.size(); }
    [[nodiscard]] std::size_t mixed_triangles() const { return mixed_triangles_; }
    // Of these, those that are divided by folds.
    [[nodiscard]] std::size_t folded_triangles() const { return folded_triangles_; }

private:
    // {p: plane . p >= offset}
    struct HalfSpace {
        Vec3d plane;
        double offset = 0;
        double slack = 0; // how far rounding may move the plane, in units of plane . p
        trace::HitSide side = trace::HitSide::wall;
        bool open = false;
        std::uint32_t layer = 0;
    };
    // One interval over a triangle or region.
    struct Piece {
        // Outer end, inner end if there is one, sides: those of a triangle and of five lines at most.
        std::array<HalfSpace, 10> halves;
        unsigned count = 0;
    };
    struct Span;
    static constexpr unsigned none = 0xFFFFFFFFU; // of a piece's planes

    static bool is_pure(const FoldTriangle& triangle, bool marked);
    void add_pure(const FoldTriangle& triangle);
    void add_mixed(const FoldTriangle& triangle, Vec3d signs, bool folds);
    void add_region(const FoldTriangle& triangle, unsigned i, Vec3d signs);
    void add_folded(const FoldRegion& region);
    void limit_slopes(const StoredInterval& interval, Vec3d g, const std::array<Vec3d, 4>& region,
                      Vec3d signs, Vec3d& outer, Vec3d& inner) const;
    void add_ends(Piece& piece, Vec3d outer, Vec3d inner, bool to_center, std::size_t layer,
                  std::size_t inner_layer);
    static void add_side(Piece& piece, Vec3d plane, bool open = false);
    // Calls `visit` with the pieces whose triangles the point is in, or no farther than `reach` from; true:
    // one of the calls gave true.
    template <class Visit>
    bool any_near(Vec3d point, double reach, const Visit& visit) const;
    // Calls `visit` with the planes of pieces that the point is no farther than `reach` from and that part
    // solid from what is none; true: one of the calls gave true.
    template <class Visit>
    bool any_face(Vec3d point, double reach, const Visit& visit) const;
    // How far inside a point is; below 0: outside.
    static double depth_in(const Piece& piece, Vec3d point);
    static Vec3d moved_into(const Piece& piece, Vec3d point, unsigned but = none, double out = 0);
    void note_core(bool solid) { (solid ? some_solid_ : some_empty_) = true; }

    [[nodiscard]] std::size_t bin(unsigned octant, unsigned i, unsigned j) const {
        return (std::size_t(octant) * n_ + i) * n_ + j;
    }
    void clip_octant(unsigned octant, Vec3d o, Vec3d d, double lo, double hi, std::vector<Span>& spans) const;
    static void clip_piece(const Piece& piece, Vec3d o, Vec3d d, double lo, double hi,
                           std::vector<Span>& spans);
    void apply_core(std::vector<Event>& events, Vec3d o, Vec3d d, double t_min) const;

    std::uint32_t n_ = 0; // cells of a quadrant's side: N/2
    double w_max_ = 0, w_core_ = 0;
    bool some_solid_ = false, some_empty_ = false; // of what is below the largest W
    std::size_t mixed_triangles_ = 0, folded_triangles_ = 0;
    std::vector<Piece> pieces_; // of bin k: first_[k] .. first_[k + 1]
    std::vector<std::uint32_t> first_;
};

} // namespace spa::test
