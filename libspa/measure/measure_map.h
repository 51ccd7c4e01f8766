// SPDX-License-Identifier: Apache-2.0
// How exact a map is: every texel re-projected to a point in space and measured against the model it stands
// for, and the model's surface measured against the map. What each figure means, with pictures:
// ../../docs/measures.md.
#pragma once

#include "map_rays.h"
#include "statistics.h"
#include "texel_errors.h"

#include <optional>
#include <span>
#include <vector>

namespace spa::measure {

struct MeasureOptions {
    std::uint32_t surface_samples = 100'000; // points on the model, each standing for the same area
    std::uint32_t color_samples = 1;         // as the colours were baked (bake::Options::samples)
    std::uint32_t layers = 0; // as it was baked (bake::Options::layers): a map leaves out layers that no
                              // sample met; 0: as many as it holds
    unsigned threads = 0;     // 0 = all cores; the result does not depend on it
    // Traced through the map and the model (map_rays.h); none through maps that are not octahedral.
    std::uint32_t rays = 0;
};

struct CoverageFigures {
    std::uint64_t texels = 0;            // of all surfaces
    std::uint64_t missing = 0;           // without a surface where the model has one
    std::uint64_t extra = 0;             // with a surface where the model has none
    std::uint64_t ties = 0;              // whose direction meets an edge, where either answer is right
    [[nodiscard]] double share() const { // of texels that agree with the model
        return texels == 0 ? 1 : 1 - double(missing + extra) / double(texels);
    }
};

struct QuantizationFigures {
    double bound = 0;        // the largest error that the depth's element format can cause, in R
    Distribution error;      // |stored - exact| depth along each texel's direction, in R
    std::uint64_t above = 0; // texels above the bound by more than rounding
    [[nodiscard]] bool holds() const { return above == 0; }
};

// Where a figure is worst.
struct WorstTexel {
    std::uint32_t part = 0; // of the map
    std::uint32_t layer = 0;
    Side side = Side::outer;
    TexelIndex texel;
    double value = 0;
};

// A point of the model's surface and the map.
struct SurfaceError {
    Vec3f direction; // from the centre, frame space, any length
    float distance;  // to the map's surface, in R
    bool captured;   // an exact layer ends here
};

// Distances are in units of R, the radius of the model's bounding sphere about the map's centre.
struct Measurement {
    double source_radius = 0;      // R, in frame units; part.radius is to be equal
    Distribution texel_distance;   // every stored point to the model's surface
    Distribution surface_distance; // points spread evenly over the model's surface to the map's surface
    double captured_area = 0;      // share of the model's area that exact layers hold
    Distribution normal_angle;     // stored and exact normal, degrees
    Distribution color_difference; // stored and exact red, green, blue, in codes of 255
    Distribution alpha_difference; // the same of the colours' coverage
    CoverageFigures coverage;
    QuantizationFigures quantization;
    std::uint64_t shell_ends = 0; // inner ends of thin shells, which texel_distance leaves out
    // The parts of the error (algorithms: E_star, E_res, E_quant). star: from points that are not
    // captured to the closest that is: what no resolution mends. resolution: from captured points to the
    // surface through exact depths: what more texels mend. quantization.error is the third: what more bits
    // mend.
    Distribution star_error, resolution_error;
    std::uint64_t normals_above = 0; // normals off by more than their element format explains
    std::optional<WorstTexel> worst_distance, worst_normal, worst_color, worst_alpha, worst_depth;
    std::optional<WorstTexel> first_missing, first_extra;
    std::optional<RayFigures> rays; // with MeasureOptions::rays
    std::vector<TexelErrors> texels;
    std::vector<SurfaceError> surface;
    std::vector<double> star_distances, resolution_distances; // that star_error and resolution_error are of

    [[nodiscard]] double hausdorff() const {
        return texel_distance.max > surface_distance.max ? texel_distance.max : surface_distance.max;
    }
};

// Measures a part of a map against the model that it was baked from. O((texels + surface_samples) *
// log(triangles + texels)). Throws Error (unsupported: a part whose surfaces differ in size; invalid_data: a
// model of zero size; internal) and bake::Cancelled.
Measurement measure_map(const Model& model, const Part& part, const MeasureOptions& options,
                        const bake::Progress& progress = {});

// One measurement of a whole map from those of its parts: distances in units of `radius`, the points of all
// surfaces together, which are then to be as dense on each. Without rays. O(texels + points).
Measurement combine(std::span<const Measurement> measurements, std::span<const Part> parts, double radius);

// As they are stored in a file.
ErrorFigures error_figures(const Measurement& measurement);

} // namespace spa::measure
