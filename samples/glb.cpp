// SPDX-License-Identifier: Apache-2.0
// A model as binary glTF: one node.
#include "glb_writer.h"
#include "samples.h"

namespace spa::samples {

std::vector<std::byte> to_glb(const Model& model) {
    using Json = GlbWriter::Json;
    GlbWriter writer(model.materials, model.textures);
    writer.json["asset"] = {{"version", "2.0"}, {"generator", "spa sample"}};
    writer.json["scene"] = 0;
    writer.json["scenes"] = Json::array({{{"nodes", {0}}}});
    writer.json["nodes"] = Json::array({{{"mesh", 0}}});
    (void)writer.add_mesh(model);
    return std::move(writer).finish();
}

} // namespace spa::samples
