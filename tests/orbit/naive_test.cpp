// SPDX-License-Identifier: Apache-2.0
// The paper's way and the batches, their sizes, threads, progress and cancellation.
#include "fixture.h"

#include "../support/shapes.h"

#include <atomic>

namespace spa::test {
namespace {

class OrbitBatches : public OrbitTest {};

std::size_t differing_samples(const bake::CrossingGrid& a, const bake::CrossingGrid& b) {
    EXPECT_EQ(a.first.size(), b.first.size());
    std::size_t differing = 0;
    for_each_sample(a, [&](std::size_t s, auto list) {
        const auto other = std::span(b.crossings).subspan(b.first[s], b.first[s + 1] - b.first[s]);
        if (!std::equal(list.begin(), list.end(), other.begin(), other.end(), equal)) ++differing;
    });
    return differing;
}

TEST_F(OrbitBatches, NaiveIsTheSame) {
    const Model model = random_textured_soup(60, 21);
    const bake::CenteredModel centered = normalized(model);
    for (const Grid& grid : {octahedral(16), latlong(20, 14)}) {
        for (const bool layers : {false, true}) {
            EXPECT_LE(differing_samples(cast(centered, grid, layers), cast(centered, grid, layers, true)),
                      sample_count(grid) / 1000)
                << name_of(grid) << (layers ? " layers" : " outermost");
        }
    }
}

// More pairs of triangle and view than two batches hold, so that buffers are filled again.
TEST_F(OrbitBatches, SeveralBatches) {
    const Model model = random_textured_soup(300, 22);
    const bake::CenteredModel centered = normalized(model);
    int batches = 0;
    bake::CastOptions options;
    options.progress = [&](double) { return ++batches > 0; };
    const bake::CrossingGrid crossings =
        bake::cast_orbit(*context, centered, latlong(400, 300), false, options);
    EXPECT_GE(batches, 3);
    const Comparison result = compare_with_reference(crossings, centered, false, 11);
    EXPECT_EQ(result.wrong, 0U);
    EXPECT_LE(result.color, 1);
}

// More views than fit the tiles at once.
TEST_F(OrbitBatches, SeveralBands) {
    Model model = empty_model();
    add_box(model, {-0.5F, -0.5F, -0.5F}, {0.5F, 0.5F, 0.5F});
    const bake::CenteredModel centered = normalized(model);
    const Grid grid = latlong(1024, 600);
    const bake::CrossingGrid crossings = cast(centered, grid, false);
    ASSERT_EQ(crossings.crossings.size(), sample_count(grid));
    const Comparison result = compare_with_reference(crossings, centered, false, 11);
    EXPECT_EQ(result.wrong, 0U);
    EXPECT_GT(result.compared, sample_count(grid) / 12);
}

TEST_F(OrbitBatches, ThreadsDoNotMatter) {
    const Model model = random_textured_soup(300, 23);
    const bake::CenteredModel centered = normalized(model);
    const auto run = [&](unsigned threads) {
        bake::CastOptions options;
        options.outermost_only = false;
        options.threads = threads;
        return bake::cast_orbit(*context, centered, octahedral(64), false, options);
    };
    const bake::CrossingGrid one = run(1);
    EXPECT_EQ(differing_samples(one, run(2)), 0U);
    EXPECT_EQ(differing_samples(one, run(0)), 0U);
}

TEST_F(OrbitBatches, ProgressGoesUpToOneAtMost) {
    const Model model = random_textured_soup(50, 24);
    const bake::CenteredModel centered = normalized(model);
    for (const bool naive : {false, true}) {
        for (const bool layers : {false, true}) {
            double last = 0;
            int calls = 0;
            bake::CastOptions options;
            options.outermost_only = !layers;
            options.progress = [&](double share) {
                EXPECT_GE(share, last);
                EXPECT_LE(share, 1);
                last = share;
                ++calls;
                return true;
            };
            bake::cast_orbit(*context, centered, octahedral(8), naive, options);
            EXPECT_GT(calls, 0);
        }
    }
}

TEST_F(OrbitBatches, CancelledMidway) {
    const Model model = random_textured_soup(50, 25);
    const bake::CenteredModel centered = normalized(model);
    for (const bool naive : {false, true}) {
        bake::CastOptions options;
        options.outermost_only = false;
        int calls = 0;
        options.progress = [&](double) { return ++calls < 3; };
        EXPECT_THROW(bake::cast_orbit(*context, centered, octahedral(8), naive, options), bake::Cancelled);
        EXPECT_EQ(calls, 3);
    }
    // The context still works.
    EXPECT_FALSE(cast(centered, octahedral(8), true).crossings.empty());
}

} // namespace
} // namespace spa::test
