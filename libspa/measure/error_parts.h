// SPDX-License-Identifier: Apache-2.0
// What the error of a map is made of, by rays: ../../docs/measures.md, "Rays".
#pragma once

#include "trace_methods.h"

#include "../bake/bake.h"
#include "../mesh/model.h"

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

namespace spa::measure {

// Mean |dt| in R between neighbours in a row of stand-ins, over rays that hit all of them:
// model - map without bits or texels to speak of (f32, ideal_cells) - the same at the map's size - with the
// map's bits - with the tracer's arithmetic. No map is farther from the model than their sum.
struct ErrorParts {
    double star = 0, resolution = 0, quantization = 0;
    // From the stored surface as triangles, in Embree's robust mode. Maps of one layer without mixed
    // triangles alone (docs/tracing.md): the surface of others is no such mesh.
    std::optional<double> solver;
    double total = 0; // model - map as traced, over the same rays
};
constexpr std::uint32_t ideal_cells = 1024;

// An octahedral bake of `cells` a side with the usual normals and colours.
bake::OwnedMap bake_octahedral(const Model& model, std::uint32_t cells, std::uint32_t layers,
                               ElementFormat depth);

// For one model and one set of rays.
class ErrorPartsMeter {
public:
    // All outlive this object. truth: of the batch.
    ErrorPartsMeter(const Model& model, RayBatch& batch, std::span<const RayAnswer> truth)
        : model_(model), batch_(batch), truth_(truth) {}

    // method: projective, of a map of the model with u16 depths. Bakes and traces in the caller's arena.
    // Throws as bake_model does.
    ErrorParts measure(const TraceMethod& method);

private:
    using Answers = std::vector<RayAnswer>;
    [[nodiscard]] Answers trace_baked(std::uint32_t cells, std::uint32_t layers, ElementFormat depth) const;
    [[nodiscard]] Answers judge(const TraceMethod& method) const;

    const Model& model_;
    RayBatch& batch_;
    std::span<const RayAnswer> truth_;
    std::map<std::uint32_t, Answers> ideal_; // by layers
};

} // namespace spa::measure
