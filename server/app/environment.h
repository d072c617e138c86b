// The variables of the environment that are the server's options. A mistyped one would otherwise be no option
// at all, and nobody would notice: a world that is not kept, a server without its limit.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace scree {

/// The first variable that begins with SCREE_ and belongs to no program of Scree, in words, with the nearest
/// name of the server's own; empty: there is none. `environment`: as of environ(7), "NAME=VALUE" and a null
/// at the end.
std::string fault_in_environment(std::span<const std::string> own, const char* const* environment);

/// Those of the other programs, which a shell may have set as well.
std::span<const std::string_view> variables_of_others();

}  // namespace scree
