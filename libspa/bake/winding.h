// SPDX-License-Identifier: Apache-2.0
// Whether the solid holds the centre, from the triangles alone. Source: ../../docs/baking.md, "Intervals".
#pragma once

#include "crossings.h"

#include "../mesh/components.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace spa::bake {

// The generalised winding number of each piece at the centre: the sum of the solid angles of its triangles
// (Van Oosterom & Strackee 1983) over 4 pi. For bakes that do not find all crossings; of triangles that alpha
// makes invisible it knows nothing. Error below 1e-4. The sums do not depend on the order of the triangles,
// nor on the threads that add them.
class WindingNumbers {
public:
    // `components` outlives it.
    explicit WindingNumbers(const Components& components)
        : components_(components), sums_(components.count) {}

    // What one thread adds; several may at once. Adding is cheapest for triangles of one piece in a row. What
    // was added counts when the run has ended.
    class Run {
    public:
        explicit Run(WindingNumbers& numbers) : numbers_(numbers) {}
        ~Run() { flush(); }
        Run(const Run&) = delete;
        Run& operator=(const Run&) = delete;
        // Corners relative to the centre, in the model's order.
        void add(std::size_t triangle, Vec3d a, Vec3d b, Vec3d c);

    private:
        void flush();

        WindingNumbers& numbers_;
        std::uint32_t component_ = 0;
        std::uint64_t sum_ = 0;
    };

    // True if that of some piece is above solid_winding (intervals.h), whichever way the piece is wound.
    [[nodiscard]] bool any_solid() const;

private:
    const Components& components_;
    std::vector<std::uint64_t> sums_; // fixed point, modulo 2^64
};

} // namespace spa::bake
