// SPDX-License-Identifier: Apache-2.0
#include "ray_report.h"

#include "text.h"

#include <nlohmann/json.hpp>

namespace spa::tools {

namespace {

using Json = nlohmann::ordered_json;
using measure::Distribution;
using measure::RayFigures;

Json distribution_json(const Distribution& d) {
    return {{"count", d.count}, {"median", d.median}, {"p95", d.p95},
            {"p99", d.p99},     {"max", d.max},       {"mean", d.mean}};
}

std::string distribution_text(const Distribution& d, const char* unit) {
    return "median " + significant(d.median, 3) + ", 95 % " + significant(d.p95, 3) + ", 99 % " +
           significant(d.p99, 3) + ", max " + significant(d.max, 3) + " " + unit;
}

double share(std::uint64_t part, std::uint64_t whole) {
    return whole == 0 ? 0 : double(part) / double(whole);
}

std::string false_text(std::uint64_t all, std::uint64_t interior, std::uint64_t star, std::uint64_t rays) {
    std::string text = percent(share(all, rays), 3);
    if (all == 0) return text;
    return text + ": " + std::to_string(all - interior) + " in the silhouette band, " +
           std::to_string(interior) + " interior; " + percent(share(star, all), 0) + " are E_star";
}

} // namespace

Json rays_json(const RayFigures& figures) {
    const measure::RayErrors& e = figures.errors;
    return {
        {"count", e.rays()},
        {"band_width", figures.band_width},
        {"hit", e.band.both + e.interior.both},
        {"passed", e.band.neither + e.interior.neither},
        {"false_hits",
         {{"share", figures.false_hits()},
          {"band", e.band.extra},
          {"interior", e.interior.extra},
          {"star", figures.star_extra}}},
        {"missed_hits",
         {{"share", figures.missed_hits()},
          {"band", e.band.missed},
          {"interior", e.interior.missed},
          {"star", figures.star_missed}}},
        {"distance", distribution_json(e.distance)},
        {"interior_distance", distribution_json(e.interior_distance)},
        {"normal_angle", distribution_json(e.normal)},
        {"color_difference", distribution_json(e.color)},
    };
}

std::string rays_text(const RayFigures& figures, std::size_t label_width) {
    const measure::RayErrors& e = figures.errors;
    const auto line = [&](const char* label, const std::string& text) {
        return pad_right(label, label_width) + text + "\n";
    };
    const std::uint64_t both = e.band.both + e.interior.both;
    const std::uint64_t neither = e.band.neither + e.interior.neither;
    std::string text =
        line("rays", std::to_string(e.rays()) + ": " + percent(share(both, e.rays()), 1) +
                         " hit the map and the source, " + percent(share(neither, e.rays()), 1) + " neither");
    text += line("  false hits", false_text(figures.extra(), e.interior.extra, figures.star_extra, e.rays()));
    text +=
        line("  missed hits", false_text(figures.missed(), e.interior.missed, figures.star_missed, e.rays()));
    text += line("  distance", distribution_text(e.distance, "R"));
    text += line("    interior", distribution_text(e.interior_distance, "R"));
    text += line("  normal", distribution_text(e.normal, "degrees"));
    return text + line("  colour", distribution_text(e.color, "of 255"));
}

} // namespace spa::tools
