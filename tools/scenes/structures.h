// What is built on generated ground by fills, and parts of it that benches build at places of their own.
// Metres.
#pragma once

#include "tools/scenes/scene.h"

namespace scree {

/// A post that stands on the ground there, 8 m high, and what must be carved away for it to fall.
Shape post_at(glm::vec3 ground_m);
Shape foot_of_post(glm::vec3 ground_m);

/// A beam on posts at those places of the ground, which differ in x; with the posts: an arch.
Shape beam_between(glm::vec3 left_m, glm::vec3 right_m);

/// A carve of that shape, broken evenly about `impact_m`, out of which pieces fly towards there.
CarveRequest strike(const Shape& shape, glm::vec3 impact_m, uint32_t seeds, float speed_m_s);

Result<SceneSetup> plain_scene(const std::string& folder);
Result<SceneSetup> cliffs_scene(const std::string& folder);
Result<SceneSetup> arch_scene(const std::string& folder);
Result<SceneSetup> tower_scene(const std::string& folder);
Result<SceneSetup> bridge_scene(const std::string& folder);
Result<SceneSetup> quarry_scene(const std::string& folder);

}  // namespace scree
