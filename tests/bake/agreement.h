// SPDX-License-Identifier: Apache-2.0
// How far maps baked with different casters agree, and why they do not.
#pragma once

#include "../../libspa/bake/bake.h"

#include <cstdint>

namespace spa::test {

// Shares are those of the worst surface of the map; surfaces that neither has do not count.
struct Agreement {
    double coverage = 0;         // share of samples with a surface in one map alone
    double depth = 0;            // share of common samples whose depths differ by more than two codes of u16
    double color = 0;            // mean difference in codes of 255
    std::uint32_t color_max = 0; // the largest difference of a channel
    double normal = 0;           // median difference in degrees
    std::uint64_t differing = 0; // samples whose coverage or depth differs in some surface
    std::uint64_t ties = 0;      // of these: the ray passes within edge_tie of an edge of a triangle that one
                                 // caster reports and the other does not
    std::uint64_t unexplained = 0; // the others
    std::uint64_t mixed = 0;       // triangles that are mixed in one map alone
};

// Distance between a ray and an edge in units of R: what float arithmetic cannot tell from 0.
constexpr double edge_tie = 2e-6;

// The bar of the project: 99.9 % of coverage and depth, a mean of one code of colour.
bool agrees(const Agreement& agreement);

class Comparison {
public:
    // Bakes with the radial baker. The model outlives it. The two grids of `options` are equal.
    Comparison(const Model& model, const bake::Options& options);

    // The bake with another caster against it. Throws what make_gl_context does.
    [[nodiscard]] Agreement of_orbit(bake::GlApi gl) const;
    [[nodiscard]] Agreement of_embree() const;

private:
    struct Baked {
        bake::Result result;
        bake::CenteredModel model;
        bake::CrossingGrid crossings;
    };
    [[nodiscard]] Baked bake_by(const bake::Caster& caster) const;
    [[nodiscard]] Agreement of(const Baked& other) const;
    [[nodiscard]] bool is_tie(const bake::CrossingGrid& other, std::size_t sample) const;

    const Model& model_;
    bake::Options options_;
    Baked radial_;
};

} // namespace spa::test
