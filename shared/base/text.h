// Text from outside that people read in logs, on terminals and on screens. It must be valid UTF-8 without
// control characters (C0, DEL, C1). Characters that set its direction could make it read as another text, and
// invisible ones could make two texts look alike: both are refused. Those that shape the character before
// them may stay where there is one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace scree {

/// What is wrong with it, as the end of a sentence; nothing when it may be shown.
std::optional<std::string_view> fault_of_text(std::string_view text);

/// RFC 3629: shortest forms, no surrogates.
bool is_utf8(std::string_view text);

/// The text cut to the limit at the end of a character, each character that may not be shown replaced by a
/// space, each byte that is no UTF-8 by '?'. fault_of_text() finds nothing in it.
std::string showable(std::string_view text, size_t bytes_max);

/// "host:port", an IPv6 address in brackets; the host alone where the port is not known, 0.
std::string endpoint_text(std::string_view host, uint16_t port);

}  // namespace scree
