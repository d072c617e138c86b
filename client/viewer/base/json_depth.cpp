#include "client/viewer/base/json_depth.h"

#include <string>

#include "client/viewer/base/limits.h"

namespace scree {

Result<void> check_json_depth(std::string_view text) {
  size_t depth = 0;
  bool quoted = false;
  for (size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '"') quoted = !quoted;
    if (quoted) {
      if (c == '\\') ++i;
      continue;
    }
    if (c == '[' || c == '{') ++depth;
    if ((c == ']' || c == '}') && depth > 0) --depth;
    if (depth > limits::json_depth_max)
      return fail("it nests deeper than " + std::to_string(limits::json_depth_max) +
                  " levels (limits.json_depth_max)");
  }
  return {};
}

}  // namespace scree
