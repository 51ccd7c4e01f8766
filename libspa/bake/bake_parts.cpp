// SPDX-License-Identifier: Apache-2.0
#include "bake_parts.h"

#include "../core/error.h"
#include "../mesh/piece_model.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace spa::bake {
namespace {

void move_part(OwnedMap& from, const Piece& piece, OwnedMap& to) {
    Part& part = from.map.parts.front();
    part.node = piece.node;
    part.joint = piece.joint;
    part.to_node = piece.to_node;
    to.map.parts.push_back(std::move(part));
    std::move(from.pixels.begin(), from.pixels.end(), std::back_inserter(to.pixels));
}

void add(FoldStatistics& sum, const FoldStatistics& one) {
    sum.edges += one.edges;
    sum.searched += one.searched;
    sum.directions += one.directions;
    sum.pairs += one.pairs;
    sum.singles += one.singles;
    sum.unresolved += one.unresolved;
}

void add_counts(Report& sum, const Report& one) {
    sum.triangles += one.triangles;
    sum.components += one.components;
    sum.open_edges += one.open_edges;
    sum.turned_triangles += one.turned_triangles;
    sum.flipped_components += one.flipped_components;
    sum.solid_components += one.solid_components;
    sum.edge_on_triangles += one.edge_on_triangles;
    sum.unseen_components += one.unseen_components;
    sum.back_facing_samples += one.back_facing_samples;
    sum.thin_samples += one.thin_samples;
    sum.truncated_samples += one.truncated_samples;
    sum.center_on_surface = sum.center_on_surface || one.center_on_surface;
    sum.center_inside = sum.center_inside || one.center_inside;
    sum.center_moved = std::max(sum.center_moved, one.center_moved);
    sum.seconds += one.seconds;
}

} // namespace

std::string part_name(const Partition& partition, std::size_t part) {
    const std::string& name = partition[part].name;
    return "part " + std::to_string(part) + (name.empty() ? "" : " (" + name + ")");
}

PartsResult bake_parts(const Model& model, const Partition& partition, const Options& options,
                       const Progress& progress) {
    PartsResult result;
    std::size_t done = 0, all = 0;
    for (const Piece& piece : partition) all += piece.triangles.size();
    for (std::size_t i = 0; i < partition.size(); ++i) {
        const Piece& piece = partition[i];
        const double from = double(done) / double(all), share = double(piece.triangles.size()) / double(all);
        const Progress within =
            progress ? Progress([&](double f) { return progress(from + share * f); }) : Progress{};
        // Piece or whole, the same triangles make the same map; the copy would only cost memory.
        const bool is_whole = piece.triangles.size() == model.triangles.size();
        try {
            Result baked = is_whole ? bake_model(model, options, within)
                                    : bake_model(piece_model(model, piece.triangles), options, within);
            move_part(baked.map, piece, result.map);
            result.reports.push_back(std::move(baked.report));
        } catch (const Error& error) {
            if (partition.size() == 1) throw;
            throw Error(error.code(), part_name(partition, i) + ": " + error.what());
        }
        done += piece.triangles.size();
    }
    return result;
}

Report sum(std::span<const Report> reports, const Partition& partition) {
    if (reports.size() == 1) return reports.front();
    Report whole;
    whole.gl = reports.front().gl;
    for (const Report& one : reports) add_counts(whole, one);
    for (std::size_t i = 0; i < reports.size(); ++i) {
        const Report& one = reports[i];
        const double weight = double(one.triangles) / double(whole.triangles);
        if (one.layers.size() > whole.layers.size()) whole.layers.resize(one.layers.size());
        for (std::size_t k = 0; k < one.layers.size(); ++k) {
            whole.layers[k].outer_coverage += weight * one.layers[k].outer_coverage;
            whole.layers[k].inner_coverage += weight * one.layers[k].inner_coverage;
        }
        if (one.mixed_triangles)
            whole.mixed_triangles = whole.mixed_triangles.value_or(0) + weight * *one.mixed_triangles;
        if (one.folds) {
            if (!whole.folds) whole.folds.emplace();
            add(*whole.folds, *one.folds);
        }
        for (const std::string& warning : one.warnings)
            whole.warnings.push_back(part_name(partition, i) + ": " + warning);
    }
    return whole;
}

} // namespace spa::bake
