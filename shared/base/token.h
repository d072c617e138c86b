// Secrets that clients present: the one that lets a client change a server's settings, here called token, and
// others.
#pragma once

#include <string>
#include <string_view>

#include "shared/base/result.h"

namespace scree {

/// Refuses a secret that is longer, or has anything but printable ASCII characters; a space is refused, too.
Result<void> check_secret(std::string_view secret, size_t bytes_max);
/// The first line of a file, without its line end. Refused when check_secret refuses it.
Result<std::string> read_secret(const std::string& path, size_t bytes_max);

/// Likewise. Refused when check_token refuses it.
Result<std::string> read_token(const std::string& path);

/// Refuses a token shorter than limits::token_bytes_min, longer than token_bytes_max, or with other
/// characters.
Result<void> check_token(std::string_view token);

/// Takes equally long for all tokens of the same lengths, so the time to refuse a guess tells nothing about
/// the wanted token.
bool same_token(std::string_view given, std::string_view wanted);

}  // namespace scree
