// Which names rules and their tests find, as luacheck's configuration: taken from the machine itself, so that
// it cannot say anything else.
#pragma once

#include <string>

#include "shared/base/result.h"

namespace scree {

/// The text of a .luacheckrc for folders of rules; `tests` lies below each.
Result<std::string> luacheck_configuration();

}  // namespace scree
