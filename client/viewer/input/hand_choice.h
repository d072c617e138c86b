// How a person looks and reads.
#pragma once

#include <string>

#include "client/viewer/input/actions.h"

namespace scree {

inline constexpr float field_of_view_min_degrees = 20.0F;  ///< vertical
inline constexpr float field_of_view_max_degrees = 110.0F;
inline constexpr float mouse_speed_min = 0.1F;
inline constexpr float mouse_speed_max = 10.0F;
inline constexpr float text_scale_min = 0.5F;
inline constexpr float text_scale_max = 4.0F;

struct HandChoice {
  float field_of_view_degrees = 60.0F;
  float mouse_speed = 1.0F;  ///< 1: a seventh of a degree a pixel
  float text_scale = 1.0F;

  bool operator==(const HandChoice&) const = default;
};

/// What the action changes of it, as it is now: "field of view 65 degrees". Empty for other actions.
std::string describe(const HandChoice& choice, Action action);
/// Changes the choice, if the action concerns it.
void change(HandChoice& choice, Action action);

}  // namespace scree
