// SPDX-License-Identifier: Apache-2.0
#include "../../libspa/render/batches.h"

#include <gtest/gtest.h>

#include <vector>

namespace spa::render {
namespace {

// Every primary ray once and before its samples, every sample of every row once and in order, however long
// batches take.
void check(std::uint32_t width, std::uint32_t height, std::uint32_t antialias, std::uint32_t samples,
           double rays_a_second) {
    Batches batches(width, height, antialias, samples, 0.2);
    std::vector<std::uint32_t> primary(height, 0);
    std::vector<std::uint32_t> next(height, samples); // sample of a row
    std::size_t count = 0;
    while (const auto batch = batches.next()) {
        ASSERT_LT(++count, 1000000U);
        ASSERT_LT(batch->first_row, batch->end_row);
        ASSERT_LE(batch->end_row, height);
        ASSERT_LT(batch->first_sample, batch->end_sample);
        for (std::uint32_t row = batch->first_row; row < batch->end_row; ++row) {
            if (batch->pass == Pass::primary) {
                ASSERT_EQ(primary[row]++, batch->primary_ray);
                ASSERT_EQ(next[row], samples); // the ray before is done
                next[row] = 0;
            } else {
                ASSERT_EQ(primary[row], batch->primary_ray + 1);
                ASSERT_EQ(next[row], batch->first_sample);
                next[row] = batch->end_sample;
            }
        }
        const double rays =
            double(width) * (batch->end_row - batch->first_row) * (batch->end_sample - batch->first_sample);
        batches.took(rays / rays_a_second);
    }
    for (std::uint32_t row = 0; row < height; ++row) {
        EXPECT_EQ(primary[row], antialias);
        EXPECT_EQ(next[row], samples);
    }
    EXPECT_EQ(batches.share_done(), 1);
}

TEST(Batches, HoldEverythingOnceAndInOrder) {
    check(64, 48, 1, 16, 1e5);
    check(61, 45, 3, 7, 1e3);
    check(960, 540, 2, 128, 1e9);
    check(1, 1, 1, 1, 1);
    check(9, 9, 1, 4096, 1e4);
    check(640, 3, 4, 0, 1e6);
}

} // namespace
} // namespace spa::render
