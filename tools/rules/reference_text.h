// docs/rules-reference.md: all that rules find, made of the rows of functions, events and types.
#pragma once

#include <string>

namespace scree {

std::string reference_text();

}  // namespace scree
