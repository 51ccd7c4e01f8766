// SPDX-License-Identifier: Apache-2.0
#include "judge.h"

#include "judge_folds.h"
#include "judge_geometry.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace spa::test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
// Planes are moved out by this much, so that neighbours overlap and no ray slips between them.
constexpr double overlap = 1e-12;
// Spans of solid that are closer to each other touch.
constexpr double touching = 1e-9;

// Leaves of [lo, hi] what has a + s * b >= 0.
void clip(double a, double b, double& lo, double& hi) {
    if (b > 0)
        lo = std::max(lo, -a / b);
    else if (b < 0)
        hi = std::min(hi, -a / b);
    else if (a < 0)
        hi = -infinity;
}

} // namespace

RayD to_double(const trace::Ray& ray) {
    return {to_double(ray.origin), to_double(ray.direction), double(ray.t_min), double(ray.t_max)};
}

struct Judge::Span {
    double lo = 0, hi = 0;
    const Piece* in = nullptr;
    const Piece* out = nullptr;
    unsigned in_half = 0, out_half = 0;
};

Judge::Judge(const Part& part, std::uint32_t layers) {
    const StoredSamples samples(part, layers);
    const bool all_layers = layers == 0 || layers >= part.layers.size();
    const FoldTable folds(all_layers ? part.folds : std::span<const std::byte>{});
    const std::uint32_t cells = samples.cells();
    n_ = cells / 2;
    // Every triangle of every cell: which octant's, and where there.
    struct Entry {
        std::size_t bin;
        std::uint32_t x, y, f;
    };
    std::vector<Entry> entries;
    for (std::uint32_t y = 0; y < cells; ++y) {
        for (std::uint32_t x = 0; x < cells; ++x) {
            for (std::uint32_t f = 0; f < 2; ++f) {
                const GridTriangle triangle = grid_triangle(cells, x, y, f);
                Vec3d middle;
                for (const TexelIndex& at : triangle.corners) middle = middle + samples.direction(at);
                middle = middle * (1.0 / 3);
                const auto cell = [&](double v) { return std::uint32_t(std::floor(std::abs(v) * n_)); };
                const unsigned octant =
                    (middle.x < 0 ? 1U : 0U) | (middle.y < 0 ? 2U : 0U) | (middle.z < 0 ? 4U : 0U);
                entries.push_back({bin(octant, cell(middle.x), cell(middle.y)), x, y, f});
            }
        }
    }
    std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.bin < b.bin; });
    first_.assign(8 * std::size_t(n_) * n_ + 1, 0);
    std::size_t next = 0;
    for (std::size_t b = 0; b < 8 * std::size_t(n_) * n_; ++b) {
        first_[b] = std::uint32_t(pieces_.size());
        for (; next < entries.size() && entries[next].bin == b; ++next) {
            const Entry& entry = entries[next];
            FoldTriangle corners{
                .directions = {}, .intervals = {}, .edges = {}, .center_inside = samples.center_inside()};
            const GridTriangle triangle = grid_triangle(cells, entry.x, entry.y, entry.f);
            for (unsigned i = 0; i < 3; ++i) {
                corners.directions[i] = samples.direction(triangle.corners[i]);
                corners.intervals[i] = samples.intervals(triangle.corners[i]);
            }
            if (is_pure(corners, samples.marked_mixed(entry.x, entry.y, entry.f))) {
                add_pure(corners);
                continue;
            }
            if (!folds.empty()) corners.edges = folds.edges(cells, {entry.x, entry.y}, triangle);
            add_mixed(corners, octant_signs(unsigned(b / (std::size_t(n_) * n_))), !folds.empty());
        }
    }
    first_.back() = std::uint32_t(pieces_.size());
    w_core_ = (some_solid_ && some_empty_ ? 64 : 2) * w_max_;
}

bool Judge::is_pure(const FoldTriangle& triangle, bool marked) {
    const auto& first = triangle.intervals[0];
    return !marked &&
           std::all_of(triangle.intervals.begin(), triangle.intervals.end(), [&](const auto& other) {
               return std::equal(first.begin(), first.end(), other.begin(), other.end(),
                                 [](const StoredInterval& a, const StoredInterval& b) {
                                     return (a.inner == 0) == (b.inner == 0);
                                 });
           });
}

void Judge::add_mixed(const FoldTriangle& triangle, Vec3d signs, bool folds) {
    ++mixed_triangles_;
    const auto regions = folds ? divide(triangle) : std::nullopt;
    if (!regions.has_value()) {
        for (unsigned i = 0; i < 3; ++i) add_region(triangle, i, signs);
        return;
    }
    ++folded_triangles_;
    for (const FoldRegion& region : *regions) add_folded(region);
}

void Judge::add_folded(const FoldRegion& region) {
    for (const FoldRegion::Interval& interval : region.intervals) {
        Piece piece;
        add_ends(piece, interval.outer, interval.inner, interval.to_center, interval.layer,
                 interval.inner_layer);
        for (const Vec3d& corner : region.corners)
            w_max_ = std::max({w_max_, dot(interval.outer, corner), dot(interval.inner, corner)});
        for (std::size_t side = 0; side < region.sides.size(); ++side)
            add_side(piece, region.sides[side], interval.open == side);
        pieces_.push_back(piece);
    }
    note_core(!region.intervals.empty() && region.intervals.back().to_center);
}

void Judge::add_pure(const FoldTriangle& triangle) {
    const auto& corners = triangle.intervals;
    const auto& g = triangle.directions;
    const Barycentric lambda(g[0], g[1], g[2]);
    bool to_center = false;
    for (std::size_t k = 0; k < corners[0].size(); ++k) {
        Piece piece;
        Vec3d outer, inner;
        for (unsigned i = 0; i < 3; ++i) {
            outer = outer + lambda.form[i] * corners[i][k].outer;
            inner = inner + lambda.form[i] * corners[i][k].inner;
            w_max_ = std::max({w_max_, corners[i][k].outer, corners[i][k].inner});
        }
        to_center = corners[0][k].inner == 0;
        add_ends(piece, outer, inner, to_center, k, k);
        for (const Vec3d& side : lambda.form) add_side(piece, side);
        pieces_.push_back(piece);
    }
    note_core(to_center);
}

void Judge::add_region(const FoldTriangle& triangle, unsigned i, Vec3d signs) {
    const auto& directions = triangle.directions;
    const unsigned j = (i + 1) % 3;
    const unsigned k = (i + 2) % 3;
    const Vec3d g = directions[i];
    const Vec3d others[2] = {directions[j], directions[k]};
    const Barycentric lambda(directions[0], directions[1], directions[2]);
    const std::array<Vec3d, 4> region = {g, (g + others[0]) * 0.5, (g + others[1]) * 0.5,
                                         (g + others[0] + others[1]) * (1.0 / 3)};
    bool to_center = false;
    for (std::size_t layer = 0; layer < triangle.intervals[i].size(); ++layer) {
        const StoredInterval& interval = triangle.intervals[i][layer];
        Piece piece;
        to_center = interval.inner == 0;
        Vec3d outer, inner;
        limit_slopes(interval, g, region, signs, outer, inner);
        add_ends(piece, outer, inner, to_center, layer, layer);
        for (const Vec3d& corner : region)
            w_max_ = std::max({w_max_, dot(outer, corner), to_center ? 0 : dot(inner, corner)});
        add_side(piece, lambda.form[j]);
        add_side(piece, lambda.form[k]);
        for (const unsigned other : {j, k})
            add_side(piece, lambda.form[i] - lambda.form[other],
                     triangle.center_inside && to_center && triangle.intervals[other].empty());
        pieces_.push_back(piece);
    }
    note_core(to_center);
}

// The ends' planes as linear forms: an end W(a, b) is the points with form . p = 1, since W(a, b) |p|_1 is
// linear in p and w = 1/|p|_1. In this shape G . ((a, b) - (a_i, b_i)) is (form - W_i signs) . g.
void Judge::limit_slopes(const StoredInterval& interval, Vec3d g, const std::array<Vec3d, 4>& region,
                         Vec3d signs, Vec3d& outer, Vec3d& inner) const {
    const auto end = [&](double w, Vec3d normal) {
        const Vec3d flat = signs * w;
        const double nq = dot(normal, g) / w;
        if (nq == 0) return flat;
        const Vec3d slope = normal * (1 / nq) - flat;
        double steepest = 0;
        for (const Vec3d& corner : region) steepest = std::max(steepest, std::abs(dot(slope, corner)));
        // 4 h, h = 2/N = 1/n; a half at most, so that W stays above 0 on the smallest grids.
        const double limit = std::min(4.0 / n_, 0.5) * w;
        return flat + slope * (steepest > limit ? limit / steepest : 1.0);
    };
    outer = end(interval.outer, interval.outer_normal);
    if (interval.inner == 0) return;
    inner = end(interval.inner, interval.inner_normal);
    for (const Vec3d& corner : region) {
        if (dot(outer, corner) <= dot(inner, corner) * (1 + overlap)) continue;
        outer = signs * interval.outer;
        inner = signs * interval.inner;
        return;
    }
}

void Judge::add_ends(Piece& piece, Vec3d outer, Vec3d inner, bool to_center, std::size_t layer,
                     std::size_t inner_layer) {
    const auto add = [&](Vec3d plane, double offset, trace::HitSide side, std::size_t of) {
        piece.halves[piece.count++] = {.plane = plane,
                                       .offset = offset,
                                       .slack = overlap * (1 + length(plane)),
                                       .side = side,
                                       .layer = std::uint32_t(of)};
    };
    add(-outer, -1, trace::HitSide::outer, layer);
    if (!to_center) add(inner, 1, trace::HitSide::inner, inner_layer);
}

// A wall has the layer of the outer end.
void Judge::add_side(Piece& piece, Vec3d plane, bool open) {
    piece.halves[piece.count++] = {normalize(plane),     0,    overlap,
                                   trace::HitSide::wall, open, piece.halves[0].layer};
}

void Judge::clip_piece(const Piece& piece, Vec3d o, Vec3d d, double lo, double hi, std::vector<Span>& spans) {
    Span span{lo, hi, &piece, &piece, none, none};
    for (unsigned k = 0; k < piece.count; ++k) {
        const HalfSpace& half = piece.halves[k];
        const double a = dot(half.plane, o) - half.offset + half.slack;
        const double b = dot(half.plane, d);
        if (b > 0) {
            const double s = -a / b;
            if (s > span.lo) span.lo = s, span.in_half = k;
        } else if (b < 0) {
            const double s = -a / b;
            if (s < span.hi) span.hi = s, span.out_half = k;
        } else if (a < 0) {
            return;
        }
        if (span.lo > span.hi) return;
    }
    spans.push_back(span);
}

void Judge::clip_octant(unsigned octant, Vec3d o, Vec3d d, double lo, double hi,
                        std::vector<Span>& spans) const {
    constexpr double margin = 1e-9;
    const Vec3d s = octant_signs(octant);
    o = {o.x * s.x, o.y * s.y, o.z * s.z};
    const Vec3d e{d.x * s.x, d.y * s.y, d.z * s.z};
    clip(o.x + margin, e.x, lo, hi);
    clip(o.y + margin, e.y, lo, hi);
    clip(o.z + margin, e.z, lo, hi);
    if (lo > hi) return;
    const double ol = o.x + o.y + o.z;
    const double el = e.x + e.y + e.z;
    // A coordinate over l is monotonous where l > 0; close to the centre anything may be met.
    const auto cells = [&](double c, double ec, double from, double to) {
        const double l0 = ol + from * el;
        const double l1 = ol + to * el;
        if (!(std::min(l0, l1) > 1e-3)) return CellRange{0, n_ - 1};
        return cells_between((c + from * ec) / l0, (c + to * ec) / l1, n_);
    };
    const auto strip = [&](double c, double ec, std::uint32_t cell, double& from, double& to) {
        const double below = double(cell) / n_;
        const double above = double(cell + 1) / n_;
        clip(c - below * ol + margin, ec - below * el, from, to);
        clip(above * ol - c + margin, above * el - ec, from, to);
        return from <= to;
    };
    const Vec3d back_o{o.x * s.x, o.y * s.y, o.z * s.z};
    const CellRange rows = cells(o.x, e.x, lo, hi);
    for (std::uint32_t i = rows.first; i <= rows.last; ++i) {
        double row_lo = lo;
        double row_hi = hi;
        if (!strip(o.x, e.x, i, row_lo, row_hi)) continue;
        const CellRange columns = cells(o.y, e.y, row_lo, row_hi);
        for (std::uint32_t j = columns.first; j <= columns.last; ++j) {
            const std::size_t b = bin(octant, i, j);
            if (first_[b] == first_[b + 1]) continue;
            double cell_lo = row_lo;
            double cell_hi = row_hi;
            if (!strip(o.y, e.y, j, cell_lo, cell_hi)) continue;
            for (std::uint32_t p = first_[b]; p < first_[b + 1]; ++p)
                clip_piece(pieces_[p], back_o, d, lo - margin, hi + margin, spans);
        }
    }
}

std::vector<Event> Judge::events(const RayD& ray) const {
    std::vector<Event> events;
    const double speed = length(ray.direction);
    if (!(speed > 0) || !std::isfinite(speed) || !is_finite(ray.origin)) return events;
    // In lengths, from the foot of the perpendicular from the centre.
    const Vec3d d = ray.direction * (1 / speed);
    const double foot = -dot(ray.origin, d);
    const Vec3d o = ray.origin + d * foot;
    constexpr double before = 1e-3;
    const double from = ray.t_min * speed - foot;
    const double to = ray.t_max * speed - foot;
    std::vector<Span> spans;
    for (unsigned octant = 0; octant < 8; ++octant)
        clip_octant(octant, o, d, std::max(from - before, -1e3), std::min(to + before, 1e3), spans);
    std::sort(spans.begin(), spans.end(), [](const Span& a, const Span& b) { return a.lo < b.lo; });
    const auto event = [](double t, bool enters, const Piece& piece, unsigned k) {
        if (k >= piece.count) return Event{.t = t, .enters = enters}; // a limit of the ray
        const HalfSpace& half = piece.halves[k];
        return Event{.t = t,
                     .enters = enters,
                     .side = half.side,
                     .open = half.open,
                     .layer = half.layer,
                     .normal = normalize(-half.plane)};
    };
    for (std::size_t i = 0; i < spans.size();) {
        Span solid = spans[i];
        for (++i; i < spans.size() && spans[i].lo <= solid.hi + touching; ++i) {
            if (spans[i].hi <= solid.hi) continue;
            solid.hi = spans[i].hi;
            solid.out = spans[i].out;
            solid.out_half = spans[i].out_half;
        }
        events.push_back(event(solid.lo, true, *solid.in, solid.in_half));
        events.push_back(event(solid.hi, false, *solid.out, solid.out_half));
    }
    apply_core(events, o, d, from);
    for (Event& e : events) e.t = (e.t + foot) / speed;
    return events;
}

// What happens in the core is seen where the ray leaves it, as a wall.
void Judge::apply_core(std::vector<Event>& events, Vec3d o, Vec3d d, double t_min) const {
    double lo = -infinity;
    double hi = infinity;
    for (unsigned octant = 0; octant < 8; ++octant) {
        const Vec3d s = octant_signs(octant);
        clip(1 / w_core_ - dot(s, o), -dot(s, d), lo, hi);
    }
    if (!(lo < hi)) return;
    const auto inside = [&](const Event& e) { return e.t > lo && e.t < hi; };
    const auto first = std::find_if(events.begin(), events.end(), inside);
    const auto last = std::find_if_not(first, events.end(), inside);
    if (first == last) return;
    const bool one_left = (last - first) % 2 == 1;
    Event seen = *(last - 1);
    seen.t = hi;
    seen.core_length = hi - lo;
    seen.side = trace::HitSide::wall;
    seen.open = false;
    const auto place = events.erase(first, last);
    // A ray that starts in the core starts with what is there where it leaves it.
    if (one_left) {
        if (t_min > lo) seen.t = std::min(lo, t_min);
        events.insert(place, seen);
    }
}

std::optional<Event> Judge::first(const RayD& ray, std::uint32_t flags) const {
    return first(events(ray), ray, flags);
}

std::optional<Event> Judge::first(const std::vector<Event>& events, const RayD& ray, std::uint32_t flags) {
    for (const Event& event : events) {
        if (event.t > ray.t_max) break;
        if (event.t < ray.t_min || event.open) continue;
        if ((flags & (event.enters ? trace::cull_front : trace::cull_back)) != 0) continue;
        return event;
    }
    return std::nullopt;
}

std::vector<Event> Judge::without_thin_gaps(const std::vector<Event>& events, const RayD& ray,
                                            double reach) const {
    std::vector<Event> left;
    for (std::size_t i = 0; i < events.size(); ++i) {
        if (!events[i].enters && i + 1 < events.size()) {
            const double middle = (events[i].t + events[i + 1].t) / 2;
            if (near_boundary(ray.origin + ray.direction * middle, reach)) {
                ++i;
                continue;
            }
        }
        left.push_back(events[i]);
    }
    return left;
}

double Judge::digits_lost(const RayD& ray) const {
    if (!(some_solid_ && some_empty_)) return 0;
    const Vec3d d = normalize(ray.direction);
    const double foot = std::max(-dot(ray.origin, d), ray.t_min * length(ray.direction));
    const double distance = length(ray.origin + d * foot);
    return distance * w_max_ < 1 ? 4 * double(std::numeric_limits<float>::epsilon()) * w_core_ : 0;
}

} // namespace spa::test
