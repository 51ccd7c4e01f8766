// SPDX-License-Identifier: Apache-2.0
// Random numbers that are the same with every standard library.
#pragma once

#include "../../libspa/core/vector.h"

#include <cstdint>
#include <random>

namespace spa::test {

class Random {
public:
    explicit Random(std::uint32_t seed) : engine_(seed) {}
    std::uint32_t bits() { return std::uint32_t(engine_()); }
    double uniform() { return double(bits()) / 4294967296.0; } // [0, 1)
    double operator()() { return uniform() * 2 - 1; }
    Vec3d vector() { return {(*this)(), (*this)(), (*this)()}; }
    // Even over the sphere.
    Vec3d direction() {
        for (;;) {
            const Vec3d v = vector();
            const double square = dot(v, v);
            if (square > 0.01 && square < 1) return normalize(v);
        }
    }

private:
    std::mt19937 engine_;
};

} // namespace spa::test
