// SPDX-License-Identifier: Apache-2.0
#include "packed_images.h"

#include "../core/error.h"

#include <algorithm>
#include <cstring>

namespace spa::trace {
namespace {

// Boxes are wider by this share of R: the surface they are made for is only met to rounding.
constexpr float box_margin = 1e-6F;

PackedBox box_of(const shader::SpaMap& map, bool whole_sphere) {
    // latlong images do not say where their surface is.
    if (whole_sphere || map.mapping != SPA_OCTAHEDRAL) return {{-1, -1, -1}, {1, 1, 1}};
    return {{map.box_low.x - box_margin, map.box_low.y - box_margin, map.box_low.z - box_margin},
            {map.box_high.x + box_margin, map.box_high.y + box_margin, map.box_high.z + box_margin}};
}

} // namespace

PackedImages::PackedImages(const SphericalMap& map, const CompileOptions& options, bool whole_sphere)
    : images_(options.images), whole_sphere_(whole_sphere) {
    if (map.parts.empty()) throw Error(ExitCode::usage, "there is no part to load: was the file opened?");
    for (const Part& part : map.parts) {
        const TraceMap& traced = without_images_.emplace_back(part, CompileOptions{options.layers, false});
        PackedPart& packed = parts_.emplace_back();
        packed.placement = part;
        packed.placement.layers.clear(); // views that may not outlive this object
        packed.placement.mixed = packed.placement.folds = {};
        packed.image = image_bytes_;
        packed.words = images_ ? traced.size_with_images(part) : traced.words().size();
        const std::size_t end = image_bytes_ + packed.words * sizeof(std::uint32_t);
        image_bytes_ = (end + packed_alignment - 1) / packed_alignment * packed_alignment;
    }
    for (std::size_t i = 0; i < parts_.size(); ++i) parts_[i].box = image_bytes_ + i * sizeof(PackedBox);
}

void PackedImages::write(const SphericalMap& map, std::span<std::byte> bytes) const {
    for (std::size_t i = 0; i < parts_.size(); ++i) {
        const std::span<std::uint32_t> words(reinterpret_cast<std::uint32_t*>(bytes.data() + parts_[i].image),
                                             parts_[i].words);
        if (images_)
            without_images_[i].write_with_images(map.parts[i], words);
        else
            std::ranges::copy(without_images_[i].words(), words.begin());
        const PackedBox box = box_of(without_images_[i].map(), whole_sphere_);
        std::memcpy(bytes.data() + parts_[i].box, &box, sizeof box);
    }
}

} // namespace spa::trace
