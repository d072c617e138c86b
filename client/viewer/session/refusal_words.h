// A server's refusals as a person at the picture reads them.
#pragma once

#include <string>
#include <string_view>

namespace scree {

/// In three words or so, by the refusal's name (docs/protocol.md): "too far away".
std::string_view in_brief(std::string_view refusal);

/// Without the names of settings and options, which a server's operator reads: " (dig-m3-per-s)" goes.
std::string without_options(std::string words);

}  // namespace scree
