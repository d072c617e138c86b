// The secret that lets a client change a server's settings.
#pragma once

#include <string>
#include <string_view>

#include "shared/base/result.h"

namespace scree {

/// The first line of a file, without its end.
Result<std::string> read_token(const std::string& path);

/// Whether a token can be one: within limits::token_bytes_min … token_bytes_max, printable ASCII, no spaces.
Result<void> check_token(std::string_view token);

/// Takes as long for any two of the same lengths, so that the time to refuse a guess tells nothing of it.
bool same_token(std::string_view given, std::string_view wanted);

}  // namespace scree
