// SPDX-License-Identifier: Apache-2.0
// Small spherical maps whose every byte is known, for tests of the container.
#pragma once

#include "../../libspa/core/spherical_map.h"

#include <memory>
#include <vector>

namespace spa::test {

// A map and the bytes of its images.
struct TestMap {
    SphericalMap map;
    std::vector<std::unique_ptr<std::vector<std::byte>>> pixels;
};

struct TestPart {
    Mapping mapping = Mapping::octahedral;
    std::uint32_t width = 5, height = 5;             // of depth and normals
    std::uint32_t color_width = 9, color_height = 9; // of colour
    ElementFormat depth = ElementFormat::u16;
    ElementFormat normal = ElementFormat::oct16;
    unsigned layers = 2;
    // The surface of the last layer reaches the centre: no inner images.
    bool solid_core = true;
    bool inner_colors = true;
    bool center_inside = true;
    bool mixed = true; // octahedral: which triangles are mixed is stored
    bool folds = true; // with `mixed`: there are fold records, each valid; together they mean nothing
};

// Concentric bumpy shells with holes, so that all depths differ, obey the rules of layers, and some are 0.
TestMap make_map(const std::vector<TestPart>& parts,
                 const std::string& metadata = "{\"generator\":\"test\"}");

// The example of formats/SPA.md, section 15.
TestMap make_example();

// Whether two maps are the same: every field and every byte of every image (NaN equals NaN).
bool same(const SphericalMap& a, const SphericalMap& b);

} // namespace spa::test
