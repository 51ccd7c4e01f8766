// SPDX-License-Identifier: Apache-2.0
#include "reasons.h"

#include <algorithm>
#include <cstdio>

namespace spa::plan {
namespace {

std::string number(double value) {
    char text[32];
    static_cast<void>(std::snprintf(text, sizeof text, "%.2g", value));
    std::string result = text;
    std::replace(result.begin(), result.end(), ',', '.'); // whatever the locale
    return result;
}

std::string kibibytes(std::uint64_t bytes) {
    if (bytes < 1024) return std::to_string(bytes) + " bytes";
    char text[32];
    static_cast<void>(std::snprintf(text, sizeof text, "%.1f KiB", double(bytes) / 1024));
    std::string result = text;
    std::replace(result.begin(), result.end(), ',', '.');
    return result;
}

std::string cells(std::uint32_t size) { return std::to_string(size) + " cells a side"; }

std::string why_map(const Reasons& reasons) {
    const ObjectPlan& object = reasons.object;
    const auto at = std::find_if(reasons.sizes.begin(), reasons.sizes.end(), [&](const SizeFigures& figures) {
        return figures.size == object.settings->size;
    });
    std::string text = cells(at->size) + " take " + kibibytes(at->bytes) + " instead of " +
                       kibibytes(object.bytes_triangles * reasons.places) + " of triangles" +
                       (reasons.places > 1 ? " in " + std::to_string(reasons.places) + " places" : "") +
                       " and cost an image error of " + number(at->image_error);
    if (at != reasons.sizes.begin())
        text += ", against " + number((at - 1)->image_error) + " with half the size";
    return text + ".";
}

std::string why_triangles(const Reasons& reasons) {
    const ObjectPlan& object = reasons.object;
    if (!reasons.mappable)
        return "No map can be baked of it: its triangles have no size, or its node's transform no inverse.";
    const std::uint64_t bytes = object.bytes_triangles * reasons.places;
    const SizeFigures &smallest = reasons.sizes.front(), &largest = reasons.sizes.back();
    const std::string triangles =
        "Its " + std::to_string(object.triangles) + " triangles take " + kibibytes(bytes);
    if (bytes <= smallest.bytes)
        return triangles + ", less than the smallest map with " + kibibytes(smallest.bytes) + ".";
    const auto affordable = std::find_if(reasons.sizes.rbegin(), reasons.sizes.rend(),
                                         [&](const SizeFigures& figures) { return figures.bytes < bytes; });
    const SizeFigures& best = affordable == reasons.sizes.rend() ? largest : *affordable;
    return triangles + "; the largest map below that, of " + cells(best.size) + " and " +
           kibibytes(best.bytes) + ", costs an image error of " + number(best.image_error) +
           " that others save for fewer bytes" +
           (object.captured < 0.9
                ? " (a layer holds only " + std::to_string(int(object.captured * 100)) + " % of its surface)"
                : "") +
           ".";
}

std::string why_drop(const Reasons& reasons) {
    return "Surfaces see " + number(reasons.object.views.solid_angle_mean) + " sr of it on average, below " +
           number(reasons.drop_below) + "; leaving it out costs an image error of " +
           number(reasons.without) + ".";
}

} // namespace

std::string why(const Reasons& reasons) {
    switch (reasons.object.decision) {
    case Decision::map: return why_map(reasons);
    case Decision::triangles: return why_triangles(reasons);
    case Decision::drop: break;
    }
    return why_drop(reasons);
}

} // namespace spa::plan
