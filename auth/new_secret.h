// A new secret for the admin token, as a file that only its owner can read.
#pragma once

#include <string>

#include "shared/base/result.h"

namespace scree {

/// Writes a file with a line of 128 random bits, in letters and digits, whole or not at all. An error, and
/// nothing changed, when there is a file of this name.
Result<void> write_new_secret(const std::string& path);

}  // namespace scree
