#include "client/viewer/input/hand_choice.h"

#include <algorithm>
#include <cstdio>

namespace scree {

std::string describe(const HandChoice& choice, Action action) {
  const auto told = [](const char* format, float value) {
    char text[64];
    std::snprintf(text, sizeof text, format, static_cast<double>(value));
    return std::string(text);
  };
  switch (action) {
    case Action::narrower_view:
    case Action::wider_view:
      return told("field of view %.0f degrees", choice.field_of_view_degrees);
    case Action::slower_mouse:
    case Action::faster_mouse:
      return told("mouse x %.2f", choice.mouse_speed);
    case Action::smaller_text:
    case Action::larger_text:
      return told("text x %.2f, limited by the room of the panels", choice.text_scale);
    default:
      return {};
  }
}

void change(HandChoice& choice, Action action) {
  constexpr float degrees = 5.0F, step = 1.25F;
  const auto scale = [](float& value, float factor, float min, float max) {
    value = std::clamp(value * factor, min, max);
  };
  const auto turn = [&](float by_degrees) {
    choice.field_of_view_degrees = std::clamp(choice.field_of_view_degrees + by_degrees,
                                              field_of_view_min_degrees, field_of_view_max_degrees);
  };
  switch (action) {
    case Action::narrower_view:
      turn(-degrees);
      break;
    case Action::wider_view:
      turn(degrees);
      break;
    case Action::slower_mouse:
      scale(choice.mouse_speed, 1.0F / step, mouse_speed_min, mouse_speed_max);
      break;
    case Action::faster_mouse:
      scale(choice.mouse_speed, step, mouse_speed_min, mouse_speed_max);
      break;
    case Action::smaller_text:
      scale(choice.text_scale, 1.0F / step, text_scale_min, text_scale_max);
      break;
    case Action::larger_text:
      scale(choice.text_scale, step, text_scale_min, text_scale_max);
      break;
    default:
      break;
  }
}

}  // namespace scree
