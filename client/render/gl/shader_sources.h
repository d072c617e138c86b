// The texts of shaders/, embedded when the program is built: nothing to find at run time.
#pragma once

#include <string_view>

namespace scree {

/// `name` as in shaders/, e.g. "surface.vert". Empty if there is none.
std::string_view shader_source(std::string_view name);

}  // namespace scree
