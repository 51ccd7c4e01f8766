// SPDX-License-Identifier: Apache-2.0
#include "../../libspa/measure/layers_summary.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

namespace spa::measure {
namespace {

constexpr std::uint64_t all_rays = 100000;

// A map with these numbers of rays.
LayerRow row(Reconstruction reconstruction, std::uint32_t layers, std::uint32_t cells, std::uint64_t extra,
             std::uint64_t missed, std::uint64_t interior_extra = 0) {
    LayerRow row;
    row.reconstruction = reconstruction;
    row.layers = layers;
    row.cells = cells;
    row.errors.band.extra = extra;
    row.errors.band.missed = missed;
    row.errors.interior.extra = interior_extra;
    row.errors.interior.neither = all_rays - extra - missed - interior_extra;
    row.errors.distance.mean = 1e-3 * double(extra);
    row.ns = spread_of({100});
    row.file_bytes = 1000;
    if (reconstruction != Reconstruction::one_depth) row.time_ratio = double(layers);
    return row;
}

LayersMesh mesh(const std::string& name, std::uint64_t open_edges, std::vector<LayerRow> rows) {
    LayersMesh mesh{name, {}};
    mesh.benchmark.open_edges = open_edges;
    mesh.benchmark.rows = std::move(rows);
    return mesh;
}

const LayersBar& find(const std::vector<LayersBar>& bars, const std::string& name, std::uint32_t cells) {
    const auto found = std::find_if(bars.begin(), bars.end(), [&](const LayersBar& bar) {
        return bar.name == name && bar.cells == cells;
    });
    if (found == bars.end()) throw std::runtime_error("no bar " + name);
    return *found;
}

TEST(LayerFigures, AreSharesOfAllRays) {
    LayerRow folds = row(Reconstruction::folds, 2, 128, 30, 20, 10);
    folds.fold_bytes = 100;
    const LayerFigures figures = figures_of(folds);
    EXPECT_NEAR(figures.false_hits, 40e-5, 1e-12);
    EXPECT_NEAR(figures.missed_hits, 20e-5, 1e-12);
    EXPECT_NEAR(figures.interior_false, 10e-5, 1e-12);
    EXPECT_EQ(figures.interior_missed, 0);
    EXPECT_NEAR(figures.fold_share, 0.1, 1e-12);
    EXPECT_EQ(figures_of(LayerRow{}).false_hits, 0);
}

TEST(ClosedMean, LeavesOpenMeshesOut) {
    const std::vector meshes{mesh("a", 0, {row(Reconstruction::folds, 2, 128, 10, 0)}),
                             mesh("open", 3, {row(Reconstruction::folds, 2, 128, 5000, 0)}),
                             mesh("b", 0, {row(Reconstruction::folds, 2, 128, 30, 4)})};
    EXPECT_EQ(closed_count(meshes), 2U);
    const auto mean = closed_mean(meshes);
    ASSERT_EQ(mean.size(), 1U);
    EXPECT_NEAR(mean[0].false_hits, 20e-5, 1e-12);
    EXPECT_NEAR(mean[0].missed_hits, 2e-5, 1e-12);
    EXPECT_NEAR(mean[0].distance_mean, 0.02, 1e-12);
    EXPECT_NEAR(mean[0].ns, 100, 1e-9);
    EXPECT_NEAR(mean[0].time_ratio.value(), 2, 1e-12);
    EXPECT_TRUE(closed_mean({}).empty());
}

// Where neither 128 nor 256 was measured.
TEST(LayersBars, TakeTheWorstSizeThereIs) {
    const auto bars = layers_bars(std::vector{
        mesh("only", 0,
             {row(Reconstruction::folds, 2, 32, 10, 1, 2), row(Reconstruction::folds, 2, 64, 10, 1, 4)})});
    EXPECT_NEAR(find(bars, "interior false hits", 64).value, 4e-5, 1e-12);
}

TEST(LayersBars, AreOfTheMeanAndNameTheWorstMesh) {
    const auto rows = [](std::uint64_t extra, std::uint64_t interior) {
        return std::vector{row(Reconstruction::tangents, 2, 128, 9000, 9000),
                           row(Reconstruction::folds, 2, 64, 5000, 1, 900),
                           row(Reconstruction::folds, 2, 128, extra, 300, interior)};
    };
    const auto bars = layers_bars(std::vector{mesh("good", 0, rows(100, 0)), mesh("bad", 0, rows(180, 8))});
    const LayersBar& extra = find(bars, "false hits", 128);
    EXPECT_NEAR(extra.value, 144e-5, 1e-12); // the interior ones are among them
    EXPECT_TRUE(extra.reached());
    EXPECT_EQ(extra.worst_mesh, "bad");
    EXPECT_NEAR(extra.worst, 188e-5, 1e-12);
    EXPECT_FALSE(find(bars, "missed hits", 128).reached());
    const LayersBar& interior = find(bars, "interior false hits", 128);
    EXPECT_TRUE(interior.worst_size);
    EXPECT_NEAR(interior.value, 4e-5, 1e-12);
    EXPECT_TRUE(interior.reached());
    EXPECT_THROW(find(bars, "false hits", 64), std::runtime_error) << "there is no bar at that size";
    EXPECT_THROW(find(bars, "false hits", 256), std::runtime_error) << "not measured";
    EXPECT_FALSE(find(bars, "time against one interval", 128).reached());
}

TEST(LayersBars, OfOpenMeshesSetFoldsAgainstOneDepth) {
    const auto open = [](std::uint64_t one, std::uint64_t folds) {
        return std::vector{mesh(
            "open", 1,
            {row(Reconstruction::one_depth, 1, 128, one, 0), row(Reconstruction::folds, 2, 128, folds, 0)})};
    };
    const auto bars = layers_bars(open(900, 200));
    ASSERT_EQ(bars.size(), 1U);
    EXPECT_EQ(bars[0].mesh, "open");
    EXPECT_NEAR(bars[0].value, 4.5, 1e-9);
    EXPECT_TRUE(bars[0].reached());
    EXPECT_FALSE(layers_bars(open(900, 400))[0].reached());
    EXPECT_NEAR(layers_bars(open(7, 0))[0].value, 7, 1e-9) << "at least, where there are none";
}

} // namespace
} // namespace spa::measure
