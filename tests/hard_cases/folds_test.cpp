// SPDX-License-Identifier: Apache-2.0
// Mixed triangles with folds against the judge: every hit of a ray, from outside, between layers and within.
#include "fold_maps.h"
#include "tracers.h"

#include "../../libspa/trace/trace.h"

#include <gtest/gtest.h>

#include <utility>

namespace {

using namespace spa;
using namespace spa::test;
using trace::Hit;
using trace::HitSide;

const Vec3d aside = normalize(Vec3d{0.3, -0.5, 0.81});

void judge_all(std::vector<NamedPart> parts, std::size_t least_hits) {
    for (NamedPart& part : parts) {
        SCOPED_TRACE(part.name);
        const Subject subject(std::move(part.owned));
        std::size_t hits = 0;
        for (const Vec3d& u : directions(150)) {
            const Vec3d from = u * 2.0;
            for (const double shift : {0.0, 0.3, 0.6})
                hits += subject.all_hits(ray_through(from, cross(u, aside) * shift)).size();
        }
        EXPECT_GT(hits, least_hits);
    }
}

TEST(Folds, MadeByHand) { judge_all(made_fold_parts(), 300); }
TEST(Folds, Baked) { judge_all(baked_fold_parts(), 300); }

// What is not divided by folds is divided as without them.
TEST(Folds, NonsenseIsAsWithoutRecords) {
    for (NamedPart& part : made_fold_parts()) {
        if (Judge(part.owned.part).folded_triangles() != 0) continue;
        const trace::TraceMap with(part.owned.part);
        part.owned.part.folds = {};
        const trace::TraceMap without(part.owned.part);
        for (const Vec3d& u : directions(300)) {
            const trace::Ray ray = ray_through(u * 2.0, cross(u, aside) * 0.5);
            Hit a;
            Hit b;
            EXPECT_EQ(trace::closest_hit(with, ray, 0, a), trace::closest_hit(without, ray, 0, b));
            EXPECT_EQ(a.t, b.t);
        }
    }
}

// Folds are of all layers: a map of fewer has none.
TEST(Folds, AllLayersOrNone) {
    for (NamedPart& part : made_fold_parts()) {
        if (part.owned.part.layers.size() < 2) continue;
        const trace::TraceMap outer(part.owned.part, {.layers = 1});
        const Judge judge(part.owned.part, 1);
        EXPECT_EQ(judge.folded_triangles(), 0U);
        for (const Vec3d& u : directions(100)) {
            const trace::Ray ray = ray_through(u * 2.0, cross(u, aside) * 0.5);
            Hit hit;
            trace::closest_hit(outer, ray, 0, hit);
            EXPECT_TRUE(is_right(judge_hit(judge, ray, 0, hit, time_bound(ray)).verdict)) << part.name;
        }
    }
}

// A ray next to the centre of a solid that is not around all of it leaves by the end farthest from the map's
// middle, where the box of the trace image touches the surface.
TEST(Folds, RaysFromTheCoreToTheBox) {
    for (NamedPart& part : made_fold_parts()) {
        if (part.name.find("border") == std::string::npos) continue;
        const Subject subject(std::move(part.owned));
        for (const float x : {0.0F, 1e-4F, -3e-3F}) {
            const trace::Ray ray{{x, 0, 2}, 0, {0, 0, -1}, unlimited};
            const Hit hit = subject.hit(ray, trace::cull_front);
            EXPECT_NEAR(hit.t, 2.8, 0.01);
            EXPECT_EQ(hit.side, HitSide::outer);
        }
    }
}

} // namespace
