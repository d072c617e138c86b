// Base64 with the alphabet for URLs and without padding (RFC 4648, 5).
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace scree {

std::string to_base64url(std::span<const uint8_t> bytes);

/// Nothing when the text is not the encoding of any bytes: each value has one.
std::optional<std::vector<uint8_t>> from_base64url(std::string_view text);

}  // namespace scree
