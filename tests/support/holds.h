// Whether a message names something.
#pragma once

#include <string_view>

namespace scree {

inline bool holds(std::string_view text, std::string_view part) {
  return text.find(part) != std::string_view::npos;
}

}  // namespace scree
