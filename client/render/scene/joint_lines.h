// Joints to be drawn over a scene: ropes, rods, pins, rails. No GL.
#pragma once

#include <glm/vec3.hpp>
#include <map>

#include "client/render/scene/draw_method.h"
#include "client/render/scene/line_list.h"
#include "shared/prop/joint.h"

namespace scree {

using SceneJoints = std::map<JointId, Joint>;

/// Joints near the eye whose bodies are in the scene, as thin cylinders where these are now. A rope hangs by
/// its slack, as if nothing were in its way. They get thicker with the distance, so as not to vanish.
void add_joints(LineList& lines, const SceneJoints& joints, const Scene& scene, glm::vec3 eye_m);

}  // namespace scree
