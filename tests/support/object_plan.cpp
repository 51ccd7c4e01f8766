// SPDX-License-Identifier: Apache-2.0
#include "object_plan.h"

#include <string>
#include <utility>

namespace spa::test {

nlohmann::ordered_json object_plan(const nlohmann::ordered_json& files) {
    using Json = nlohmann::ordered_json;
    const auto object = [](int node, const char* name, const char* decision, Json same_as, Json map) {
        const Json settings{{"size", "32"}, {"depth", "u16"},     {"normals", "oct16"}, {"color_size", "32"},
                            {"layers", 2},  {"center", "bounds"}, {"frame", "sphere"}};
        const bool is_map = std::string(decision) == "map";
        return Json{{"node", node},
                    {"name", name},
                    {"same_as", std::move(same_as)},
                    {"triangles", 12},
                    {"bytes_triangles", 1000},
                    {"radius", 1.0},
                    {"captured", 1.0},
                    {"star_shaped", true},
                    {"views",
                     {{"solid_angle_max", 0.1},
                      {"solid_angle_mean", 0.05},
                      {"ray_share", 0.1},
                      {"pixel_share", 0.1},
                      {"distance_median", 3.0}}},
                    {"tolerance", 0.01},
                    {"decision", decision},
                    {"settings", is_map ? settings : Json(nullptr)},
                    {"method", "projective"},
                    {"map", std::move(map)},
                    {"expected",
                     is_map ? Json{{"bytes", 10000}, {"ns", 100.0}, {"error", 0.01}, {"image_error", 0.001}}
                            : Json(nullptr)},
                    {"why", "for the test"}};
    };
    return {
        {"generator", {{"name", "spa"}, {"version", "0.1.0"}}},
        {"scene", {{"path", "scene.glb"}, {"files", files}, {"triangles", 100}}},
        {"request",
         {{"camera", nullptr},
          {"views", nullptr},
          {"samples", 1},
          {"budget_bytes", nullptr},
          {"target_image_error", 0.01}}},
        {"one_size", 64},
        {"objects",
         {object(0, "floor", "triangles", nullptr, nullptr),
          object(1, "ball", "map", nullptr, "maps/ball.spa"), object(2, "twin", "map", 1, "maps/ball.spa"),
          object(3, "stand", "map", nullptr, "maps/stand.spa"),
          object(5, "crumb", "drop", nullptr, nullptr)}},
        {"expected",
         {{"bytes", 20000},
          {"bytes_triangles", 5000},
          {"image_error", 0.01},
          {"image_error_deviation", 0.001},
          {"bytes_one_size", 100000},
          {"image_error_one_size", 0.01},
          {"one_size_of_maps", 64},
          {"bytes_one_size_of_maps", 50000},
          {"image_error_one_size_of_maps", 0.01},
          {"errors_together", 1.0}}}};
}

} // namespace spa::test
