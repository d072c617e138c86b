// A camera's place and direction as numbers and text, as --camera takes them.
#pragma once

#include <array>
#include <string>

#include "client/render/scene/camera.h"
#include "shared/base/result.h"
#include "shared/base/spawn.h"

namespace scree {

/// Short of straight up or down, radians.
inline constexpr float placed_pitch_max = 89.0F * 0.01745329F;

/// x, y, z in metres, yaw and pitch in degrees. Refuses values that are not finite, or outside the world; a
/// pitch beyond straight up or down is cut.
Result<Camera> camera_of(const std::array<float, 5>& values);
Result<Camera> camera_of(const Spawn& spawn);
/// "x,y,z,yaw,pitch" in metres and degrees, as --camera takes it.
std::string camera_text(const Camera& camera);
/// The other way round. The error says what is wrong with the text.
Result<Camera> parse_camera(const std::string& text);

}  // namespace scree
