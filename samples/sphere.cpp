// SPDX-License-Identifier: Apache-2.0
#include "shapes.h"

namespace spa::samples {

Model make_sphere(int level) {
    const IndexedMesh ball = icosphere(level);
    Model model = empty_model("direction");
    for (const Vec3d& p : ball.positions) {
        const Vec3f half = to_float(p * 0.5);
        add_vertex(model, p, {0.5F + half.x, 0.5F + half.y, 0.5F + half.z, 1});
        model.normals.push_back(to_float(p));
    }
    for (const Triangle& t : ball.triangles) add_triangle(model, t.vertex[0], t.vertex[1], t.vertex[2]);
    return model;
}

} // namespace spa::samples
