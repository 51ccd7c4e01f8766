// SPDX-License-Identifier: Apache-2.0
#include "placement.h"

#include "coarse_model.h"
#include "surface_views.h"

#include "../mesh/star_kernel.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>

namespace spa::bake {
namespace {

// What a view must be better by to be taken instead of the plain one: ../../docs/baking.md, "Centre and
// frame".
constexpr double center_margin = 0.95;
constexpr double frame_margin = 0.97;
// Below it the centre stands on some faces as good as edge-on; in units of the model's radius.
constexpr double thinnest_kernel = 1e-2;

struct Seen {
    Place place;
    View view;
};

bool better(const Seen& a, const Seen& b) { return a.view.spacing < b.view.spacing; }

// The centre with the smallest spacing found by a compass search (Kolda, Lewis & Torczon 2003): steps along
// the axes, from 1/4 to 1/32 of the radius.
Seen search_center(const SurfaceViews& views, Seen best) {
    constexpr std::size_t most_rounds = 10;
    constexpr std::array<Vec3d, 6> moves{
        {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}};
    const auto look = [&](Vec3d center) {
        const Place place{center, best.place.frame};
        return Seen{place, views.from(place)};
    };
    best = std::min(best, look(views.area_centroid()), better);
    double step = views.radius() / 4;
    for (std::size_t round = 0; round < most_rounds && step >= views.radius() / 32; ++round) {
        std::array<Seen, moves.size()> tried;
        tbb::parallel_for(std::size_t(0), moves.size(),
                          [&](std::size_t i) { tried[i] = look(best.place.center + moves[i] * step); });
        const Seen found = *std::min_element(tried.begin(), tried.end(), better); // the first of equals
        if (better(found, best))
            best = found;
        else
            step /= 2;
    }
    return best;
}

Seen captured_center(const Model& model, const SurfaceViews& views, const Seen& bounds,
                     std::span<const std::uint8_t> turned, bool& kernel) {
    const auto star = star_kernel(model, bounds.place.center, turned);
    kernel = star && star->depth > thinnest_kernel * views.radius();
    if (!kernel) return search_center(views, bounds);
    const Place place{star->point, bounds.place.frame};
    return {place, views.from(place)};
}

} // namespace

Placement place_part(const Model& model, const Options& options, std::span<const std::uint8_t> turned) {
    Placement placement;
    placement.center = bounds_center(model, placement.moved_behind);
    Mat3 stretched;
    if (options.frame != Frame::sphere) {
        const Axes box = oriented_bounds(model);
        if (!(box.extent[0] > 0)) return placement; // one point, which make_part_frame refuses
        placement.elongation = box.extent[0] / std::max(box.extent[2], 1e-6 * box.extent[0]);
        stretched = affine_frame(box);
    }
    if (options.frame == Frame::affine) {
        placement.frame_chosen = Frame::affine;
        placement.frame = stretched;
    }
    if (options.center == Center::bounds && options.frame != Frame::automatic) return placement;

    const Model coarse = coarse_model(model);
    const SurfaceViews views(coarse, options.one_depth() ? 1 : 2 * options.layers);
    const auto look = [&](const Place& place) { return Seen{place, views.from(place)}; };
    Seen seen = look({placement.center, placement.frame});
    if (options.frame == Frame::automatic) {
        const Seen affine = look({placement.center, stretched});
        if (affine.view.spacing < frame_margin * seen.view.spacing) {
            placement.frame_chosen = Frame::affine;
            placement.frame = stretched;
            seen = affine;
        }
    }
    if (options.center == Center::bounds) return placement;
    placement.captured_bounds = seen.view.captured;
    const Seen best = captured_center(model, views, seen, turned, placement.kernel);
    if (options.center == Center::captured || best.view.spacing < center_margin * seen.view.spacing) {
        placement.center_chosen = Center::captured;
        placement.moved_behind = false;
        seen = best;
    } else
        placement.kernel = false;
    placement.center = seen.place.center;
    placement.captured = seen.view.captured;
    return placement;
}

} // namespace spa::bake
