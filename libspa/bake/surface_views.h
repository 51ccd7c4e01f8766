// SPDX-License-Identifier: Apache-2.0
// How well a map around some point can hold a surface.
#pragma once

#include "../core/vector.h"
#include "../mesh/model.h"

#include <cstdint>
#include <vector>

namespace spa::bake {

// Where a part stands: lines start at the centre, evenly spread in the space of q, p = center + frame * q.
struct Place {
    Vec3d center;
    Mat3 frame; // determinant > 0
};

struct View {
    // Share of the surface, in [0, 1], that lines from the centre meet before the layers are full, estimated
    // on a coarse map.
    double captured = 0;
    // The mean, over the area, of the distance between neighbouring lines where they meet it, divided by
    // their angle and by the model's radius: what an error of reconstruction is made of. It counts as 10 at
    // most, which is that of faces seen edge-on, and so do surfaces that are not captured. A ball from its
    // centre has 1 / sqrt(3), as its radius here is that of its bounding box.
    double spacing = 0;
};

// Looks at one model from many places. The model outlives it.
class SurfaceViews {
public:
    // crossings: how many of them a direction keeps, outermost first; 2 for each interval, 1 for an outermost
    // surface alone. model: should be coarse (coarse_model.h): every look takes O(triangles).
    SurfaceViews(const Model& model, std::uint32_t crossings);

    // On the calling thread alone; several may look at once.
    [[nodiscard]] View from(const Place& place) const;

    [[nodiscard]] Vec3d area_centroid() const { return centroid_; }
    // Half the diagonal of the bounding box.
    [[nodiscard]] double radius() const { return radius_; }

private:
    struct Point {
        Vec3d position, normal;
        double area = 0; // that it stands for
    };
    void spread_points();
    [[nodiscard]] double captured(Vec3d center) const;
    [[nodiscard]] double spacing(const Place& place) const;

    const Model& model_;
    std::uint32_t crossings_;
    std::vector<Point> points_;
    double area_ = 0;
    double radius_ = 0;
    Vec3d centroid_;
};

} // namespace spa::bake
