// SPDX-License-Identifier: Apache-2.0
// Allocations against all combinations of small menus.
#include "../../libspa/plan/allocate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace {

using namespace spa::plan;

struct Best {
    std::uint64_t bytes = ~std::uint64_t(0);
    double error = 1e9;
};

// Calls visit(bytes, error) for every combination.
template <class Visit>
void each(const std::vector<Menu>& menus, const Visit& visit, std::size_t at = 0, std::uint64_t bytes = 0,
          double error = 0) {
    if (at == menus.size()) return visit(bytes, error);
    for (const Choice& choice : menus[at])
        each(menus, visit, at + 1, bytes + choice.bytes, error + choice.error);
}

std::vector<Menu> some_menus(unsigned seed) {
    std::mt19937 random(seed);
    std::vector<Menu> menus(5);
    for (Menu& menu : menus) {
        const std::size_t count = 1 + random() % 5;
        double error = double(random() % 1000);
        std::uint64_t bytes = random() % 100;
        for (std::size_t i = 0; i < count; ++i) {
            menu.push_back({bytes, error});
            bytes += 1 + random() % 200;
            error *= double(random() % 100) / 100;
        }
        std::shuffle(menu.begin(), menu.end(), random);
    }
    return menus;
}

std::uint64_t largest_step(const std::vector<Menu>& menus) {
    std::uint64_t largest = 0;
    for (const Menu& menu : menus)
        for (const Choice& a : menu)
            for (const Choice& b : menu)
                largest = std::max(largest, a.bytes > b.bytes ? a.bytes - b.bytes : 0);
    return largest;
}

void expect_consistent(const std::vector<Menu>& menus, const Allocation& allocation) {
    ASSERT_EQ(allocation.chosen.size(), menus.size());
    std::uint64_t bytes = 0;
    double error = 0;
    for (std::size_t i = 0; i < menus.size(); ++i) {
        ASSERT_LT(allocation.chosen[i], menus[i].size());
        bytes += menus[i][allocation.chosen[i]].bytes;
        error += menus[i][allocation.chosen[i]].error;
    }
    EXPECT_EQ(allocation.bytes, bytes);
    EXPECT_NEAR(allocation.error, error, 1e-9 * (1 + error));
}

TEST(Allocate, IsWithinOneStepOfTheFewestBytes) {
    for (unsigned seed = 0; seed < 200; ++seed) {
        SCOPED_TRACE(seed);
        const std::vector<Menu> menus = some_menus(seed);
        double least = 0, most = 0;
        for (const Menu& menu : menus) {
            const auto [low, high] = std::minmax_element(
                menu.begin(), menu.end(), [](const Choice& a, const Choice& b) { return a.error < b.error; });
            least += low->error;
            most += high->error;
        }
        const double target = least + (most - least) * 0.3 + 1e-9;
        Best best;
        each(menus, [&](std::uint64_t bytes, double error) {
            if (error <= target) best.bytes = std::min(best.bytes, bytes);
        });
        const Allocation allocation = allocate(menus, {target, std::nullopt});
        expect_consistent(menus, allocation);
        EXPECT_TRUE(allocation.meets_error);
        EXPECT_LE(allocation.error, target * (1 + 1e-12));
        EXPECT_GE(allocation.bytes, best.bytes);
        EXPECT_LE(allocation.bytes, best.bytes + largest_step(menus));
    }
}

TEST(Allocate, KeepsABudget) {
    for (unsigned seed = 0; seed < 200; ++seed) {
        SCOPED_TRACE(seed);
        const std::vector<Menu> menus = some_menus(seed);
        std::uint64_t fewest = 0;
        for (const Menu& menu : menus)
            fewest += std::min_element(menu.begin(), menu.end(), [](const Choice& a, const Choice& b) {
                          return a.bytes < b.bytes;
                      })->bytes;
        const std::uint64_t budget = fewest + 250;
        double best = 1e9, cheapest = 0;
        each(menus, [&](std::uint64_t bytes, double error) {
            if (bytes <= budget) best = std::min(best, error);
            if (bytes == fewest) cheapest = error;
        });
        const Allocation allocation = allocate(menus, {std::nullopt, budget});
        expect_consistent(menus, allocation);
        EXPECT_TRUE(allocation.meets_bytes);
        EXPECT_LE(allocation.bytes, budget);
        EXPECT_GE(allocation.error, best - 1e-9);
        EXPECT_LE(allocation.error, cheapest + 1e-9);
    }
}

TEST(Allocate, SaysWhichLimitIsMissed) {
    const std::vector<Menu> menus{{{100, 1.0}, {1000, 0.0}}, {{50, 2.0}}};
    EXPECT_FALSE(allocate(menus, {1.5, std::nullopt}).meets_error);
    EXPECT_FALSE(allocate(menus, {std::nullopt, 149}).meets_bytes);
    const Allocation both = allocate(menus, {2.5, 500});
    EXPECT_FALSE(both.meets_error);
    EXPECT_TRUE(both.meets_bytes);
    EXPECT_EQ(both.bytes, 150U);
    const Allocation free = allocate(menus, {});
    EXPECT_EQ(free.bytes, 1050U);
    EXPECT_TRUE(free.meets_error && free.meets_bytes);
}

TEST(Allocate, GivesBackWhatTheLastStepBroughtTooMuch) {
    // The best rate is the large step; once it is made the small one is not needed.
    const std::vector<Menu> menus{{{0, 10.0}, {10, 8.0}}, {{0, 100.0}, {1000, 0.0}}};
    const Allocation allocation = allocate(menus, {10.0, std::nullopt});
    EXPECT_EQ(allocation.bytes, 1000U);
    EXPECT_TRUE(allocation.meets_error);
}

} // namespace
