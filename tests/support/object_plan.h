// SPDX-License-Identifier: Apache-2.0
// A plan for the scene of object_scene.h.
#pragma once

#include <nlohmann/json.hpp>

namespace spa::test {

// A plan for object_scene() in scene.glb as spa plan writes it: the ball is a map (maps/ball.spa), the twin
// has the same, the stand with its crate is another (maps/stand.spa), the floor stays, the crumb is dropped.
// files: "files" of the scene.
nlohmann::ordered_json object_plan(const nlohmann::ordered_json& files);

} // namespace spa::test
