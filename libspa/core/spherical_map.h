// SPDX-License-Identifier: Apache-2.0
// A spherical map in memory: what a bake produces, what a `.spa` file holds, what tracers read. Pixels are
// views; who owns them is the business of the baker (OwnedMap) or of the file reader.
//
// Geometry of a part: a point q of the part's frame is p = center + frame * q in object space. A sample of
// direction u (unit, frame space) with normalized depth d is q = d * radius * u. Normals are frame-space
// unit vectors that point out of the solid; object space wants them by the inverse transpose of `frame`.
#pragma once

#include "affine.h"
#include "direction_map.h"
#include "element_format.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace spa {

// Row-major, rows without padding, row 0 first. An empty view (no bytes) means that the image is absent.
struct ImageView {
    std::span<const std::byte> bytes;
    std::uint32_t width = 0, height = 0;
    ElementFormat format = ElementFormat::rgba8;

    [[nodiscard]] bool empty() const { return bytes.empty(); }
    // x < width, y < height.
    [[nodiscard]] const std::byte* at(std::uint32_t x, std::uint32_t y) const {
        return bytes.data() + (std::size_t(y) * width + x) * element_size(format);
    }
};

// One crossing of every direction with the surface. Each image has its own size.
struct Surface {
    ImageView color;  // rgba8; alpha = coverage of the texel
    ImageView depth;  // u8, u16 or f32; the size of this image is the size of the map
    ImageView normal; // oct8, oct16 or rgb8

    [[nodiscard]] bool empty() const { return depth.empty(); }
};

// One interval of solid along every direction, from `outer` (larger depth) in to `inner`. Where `inner` has
// depth 0, or is absent as a whole, the solid reaches the centre. Layer 0 is the outermost.
struct Layer {
    Surface outer;
    Surface inner;
};

// Error figures measured at bake, in units of the radius (shares in [0,1]); NaN = not measured.
struct ErrorFigures {
    float texel_distance_max = std::numeric_limits<float>::quiet_NaN(); // texel -> source surface
    float texel_distance_mean = std::numeric_limits<float>::quiet_NaN();
    float surface_distance_max = std::numeric_limits<float>::quiet_NaN(); // source surface -> map
    float surface_distance_mean = std::numeric_limits<float>::quiet_NaN();
    float captured_area = std::numeric_limits<float>::quiet_NaN();         // share of the source's area
    float normal_angle_mean = std::numeric_limits<float>::quiet_NaN();     // degrees
    float color_difference_mean = std::numeric_limits<float>::quiet_NaN(); // of 255, per channel
    float quantization_bound = std::numeric_limits<float>::quiet_NaN();
};

struct ErrorFigureField {
    const char* name;
    float ErrorFigures::*value;
};

// All of them, in the order of the file format.
inline constexpr std::array<ErrorFigureField, 8> error_figure_fields{{
    {"texel_distance_max", &ErrorFigures::texel_distance_max},
    {"texel_distance_mean", &ErrorFigures::texel_distance_mean},
    {"surface_distance_max", &ErrorFigures::surface_distance_max},
    {"surface_distance_mean", &ErrorFigures::surface_distance_mean},
    {"captured_area", &ErrorFigures::captured_area},
    {"normal_angle_mean", &ErrorFigures::normal_angle_mean},
    {"color_difference_mean", &ErrorFigures::color_difference_mean},
    {"quantization_bound", &ErrorFigures::quantization_bound},
}};

struct Part {
    Vec3d center;      // object space
    double radius = 1; // of the bounding sphere, in frame units, > 0
    Mat3 frame;        // frame space -> object space, without the translation; invertible
    Mapping mapping = Mapping::octahedral;
    std::int32_t node = -1;  // index of the source's node that the part follows; -1 = the whole object
    std::int32_t joint = -1; // that node's index among the joints of its skin; -1 = it is no joint
    // From object space to the local space of `node`, in the pose that was baked: where the node stands at T
    // the part stands at T * to_node. Of a joint: its inverse bind matrix. Invertible.
    Affine to_node{};
    // The centre lies in the solid: surface bounds the solid around it in every direction that has one, and a
    // direction without surface is an opening of the mesh (the open leg of a boot), not a silhouette. false:
    // it lies outside, or it is not known.
    bool center_inside = false;
    ErrorFigures errors;
    std::vector<Layer> layers; // at least one
    // Octahedral maps: which triangles between samples are mixed, that is not to be interpolated over; the
    // layout is in cell_triangles.h, N = width of the depth images - 1. Empty: not stored.
    std::span<const std::byte> mixed;
    // Octahedral maps with `mixed`: how the crossings of samples around mixed triangles belong together; the
    // bytes of encode_folds() (folds.h). Empty: not stored.
    std::span<const std::byte> folds;
};

struct SphericalMap {
    std::vector<Part> parts;
    std::string metadata; // JSON text, UTF-8; may be empty
};

} // namespace spa
