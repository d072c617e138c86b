// Names in a row, as a sentence has them.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace scree {

/// "field, mesh or rays"
std::string listed(std::span<const std::string_view> names);

}  // namespace scree
