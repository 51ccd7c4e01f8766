// SPDX-License-Identifier: Apache-2.0
// The cheapest map that is as exact as asked for. What is tried in which order, and what it costs:
// ../../docs/budgets.md.
#pragma once

#include "candidate.h"
#include "estimate.h"
#include "metric.h"

#include "../bake/bake_parts.h"
#include "../measure/measure_map.h"

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace spa::plan {

// Each list is ascending in cost and not empty; one entry means that there is nothing to decide.
struct SearchRequest {
    bake::Options options; // of which the lists below replace what they are about
    Metric metric = Metric::p95_dt;
    double target = 0; // in the unit of the metric; R of the first frame and centre, whatever is chosen
    std::vector<std::uint32_t> cells{16, 32, 64, 128, 256, 512, 1024};
    std::vector<std::uint32_t> color_cells{16, 32, 64, 128, 256, 512, 1024};
    std::vector<std::uint32_t> layers{1, 2, 3, 4};
    std::vector<ElementFormat> depths{ElementFormat::u8, ElementFormat::u16};
    std::vector<bake::Frame> frames{bake::Frame::sphere, bake::Frame::affine};
    std::vector<bake::Center> centers{bake::Center::bounds, bake::Center::captured};
    double footprint = 0;    // ColorJudge
    double color_target = 4; // of ColorJudge::error; the least size of colour that keeps it is taken,
                             // in half of max_bytes
    std::uint64_t max_bytes = std::numeric_limits<std::uint64_t>::max(); // of the file
    std::uint64_t other_bytes = 0; // of the file beside the map itself, such as its metadata
    bool compress = true;
    // How the chosen map is measured; layers, samples of colour and threads are those of its bake.
    measure::MeasureOptions measure{.rays = measure::RayOptions{}.rays};
    bool best = false; // if nothing meets the target: take what comes nearest
};

// The tolerance of a footprint (SearchRequest::footprint, degrees), in R: a tenth of its radius at the
// distance R. Source: algorithms, "Model only what a scene needs".
double footprint_tolerance(double footprint);

// What kept a search from its target.
enum class Limit : std::uint8_t {
    none,      // nothing did
    shape,     // more samples stopped helping: layers, centre or parts would have to be others
    cells,     // the largest size was not enough, and larger ones would help
    max_bytes, // the next one would be too large
};
const char* name(Limit limit);

struct Tried {
    Candidate candidate;
    std::uint64_t bytes = 0; // of the file: the shape as encoded, colours estimated
    Estimate error;          // of no samples: not judged, since it is too large
    bool met = false;
    double seconds = 0;
};

struct TriedColor {
    std::uint32_t cells = 0;
    double error = 0;
};

struct SearchResult {
    std::vector<Tried> tried;
    std::vector<TriedColor> colors; // none if there was one size
    std::optional<Candidate> chosen;
    bool met = false;
    Limit stopped_by = Limit::none;
    // Of the chosen one, baked in full and measured as MeasureOptions of `spa bake --measure` say:
    bake::PartsResult baked;          // the parts with their error figures
    measure::Measurement measurement; // of the whole
    double error = 0;                 // the metric, in the unit of the target
    std::uint64_t bytes = 0;          // of the file, encoded, with other_bytes
    std::uint32_t refused = 0; // candidates that met the target by the search's samples and not by this
    double search_seconds = 0; // without the two of the last bake and its measurement
    double final_seconds = 0;
};

// Deterministic but for the seconds: the same for any number of threads. Throws as bake_model does,
// Error{usage} for a metric of rays and a mapping that cannot be traced, and bake::Cancelled.
SearchResult search(const Model& model, const SearchRequest& request, const bake::Progress& progress = {});

} // namespace spa::plan
