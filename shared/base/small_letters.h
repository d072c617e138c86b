// Letters of ASCII without regard of case. Any thread.
#pragma once

#include <string>

namespace scree {

/// Each letter of ASCII as a small one; all other bytes as they are.
std::string in_small_letters(std::string text);

}  // namespace scree
